"""The answers that an instructor reviews; there is one item for each student and part."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from functools import cache

from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.parts import exercise_of
from course_pkg.checking.report import Report, Verdict
from course_pkg.errors import AuthoringError
from course_pkg.grading import clean
from course_pkg.grading.grade import Flag, Grade
from course_pkg.grading.rebuild.wanted import every_wanted
from course_pkg.grading.review.applying import answer_of, is_outdated
from course_pkg.grading.review.overrides import Key, Overrides

LINES = 2_000  # The page shows at most this many lines of an answer.


@dataclass(frozen=True)
class Item:
    """The answer of one student to one part; the points in `grade` are from the checks."""

    grade: Grade = field(repr=False)
    report: Report
    answer: str  # `answer` is a digest of the student's code.
    flags: tuple[Flag, ...] = ()

    @property
    def key(self) -> Key:
        """The student and the part."""
        return self.grade.student, self.report.check

    @property
    def code(self) -> str:
        """The student's code for this part."""
        return clean.code(self.grade.code.get(self.report.check, ""))


@dataclass(frozen=True)
class Wanted:
    """The options --part, --flagged and --unfinished; without these options, all answers are shown."""

    parts: tuple[str, ...] = ()
    flagged: bool = False
    unfinished: bool = False

    def includes(self, item: Item, overrides: Overrides) -> bool:
        """Return whether the options select an answer."""
        if self.parts and item.report.check not in self.parts:
            return False
        return (not self.flagged or bool(item.flags)) and (
            not self.unfinished or is_unfinished(item, overrides)
        )


def items_of(grades: Sequence[Grade]) -> list[Item]:
    """Return all answers, sorted by part and then by student."""
    found = []
    for grade in (each.unreviewed() for each in grades):
        flags = _flags_by_part(grade)
        found += [
            Item(grade, report, answer_of(grade, report.check), tuple(flags.get(report.check, ())))
            for report in grade.reports
        ]
    return sorted(found, key=lambda item: (numbers(item.report.check), item.grade.student))


def is_unfinished(item: Item, overrides: Overrides) -> bool:
    """Return whether an instructor has to examine an answer.

    An instructor has to examine an answer in two cases. In the first case, the check gave no result and there
    is no review. In the second case, the answer has changed after the review.
    """
    if row := overrides.rows.get(item.key):
        return is_outdated(row, item.grade)
    undecided = item.report.verdict is Verdict.UNDECIDED or item.report.inconclusive
    return undecided or bool(item.grade.problem)


def identical(item: Item, items: Sequence[Item]) -> list[Item]:
    """Return other students' answers that have the same code for the same part, or [] for an empty answer."""
    if not item.code.strip():
        return []
    return [
        each
        for each in items
        if each.answer == item.answer and each.report.check == item.report.check and each.key != item.key
    ]


def marked_lines(item: Item) -> Iterator[tuple[str, str]]:
    """Compare an answer with the unchanged exercise cell that students get; yield (kind, line) for each line.

    The kinds are "same", "added" and "removed". For an answer in a package, there is no exercise cell, so all
    lines are "same".
    """
    lines = item.code.strip("\n").split("\n")[:LINES]
    given = _handed_out(item.grade.chapter).get(exercise_of(item.report.check), "")
    old = given.split("\n")
    if not given or (lines and re.match(r"# src/\S+$", lines[0])):
        yield from (("same", line) for line in lines)
        return
    before, after = ([line.rstrip() for line in each] for each in (old, lines))
    matcher = SequenceMatcher(None, before, after, autojunk=False)
    for tag, old_from, old_to, new_from, new_to in matcher.get_opcodes():
        if tag != "equal":
            yield from (("removed", line) for line in old[old_from:old_to])
        yield from (("same" if tag == "equal" else "added", line) for line in lines[new_from:new_to])


def numbers(check: str) -> list[int]:
    """Return the numbers in a part's id; parts are sorted by these numbers."""
    return [int(part) for part in check.split(".") if part.isdecimal()]


@cache
def _handed_out(chapter: str) -> dict[str, str]:
    """Return the unchanged exercise cell for each part of a chapter, or {} for an unknown chapter."""
    try:
        (path,) = NotebookStore().solutions([chapter])
    except AuthoringError:
        return {}
    return {each.part: each.blank for each in every_wanted(read(path))}


def _flags_by_part(grade: Grade) -> dict[str, list[Flag]]:
    """Return the flags of each part.

    A flag belongs to a part if the flag is about the part's cell or about a file of the part.

    A flag that belongs to no part is added to the first part.
    """
    found: dict[str, list[Flag]] = {}
    checks = [report.check for report in grade.reports]
    for flag in grade.flags:
        file = f"# src/{flag.where.removeprefix('src/')}\n"
        fitting = [
            check
            for check in checks
            if flag.where in (check, exercise_of(check)) or file in grade.code.get(check, "")
        ]
        for check in fitting or checks[:1]:
            found.setdefault(check, []).append(flag)
    return found
