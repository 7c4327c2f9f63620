"""The data of grading: the submissions, and their points.

All data can be stored as JSON and read again without a change. Therefore, a report needs only the stored
records.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from course_pkg.checking.report import Report, report_from
from course_pkg.sandbox.job import WorkFile

IN_PACKAGES = "The checks of these parts examine the packages, not the cells of the notebook"
NOTHING = "The student handed in nothing"  # If a student's folder is empty, `problem` begins with this text.
NO_TIME = "The submission time is not known, so no points are deducted for lateness."


@dataclass(frozen=True)
class Package:
    """A catkin package that a student has handed in."""

    name: str
    files: tuple[WorkFile, ...] = field(repr=False)
    origin: str  # `origin` is the path of the package's folder in the submitted folder or archive.

    def has(self, paths: Iterable[str]) -> bool:
        """Return whether the package contains all files in `paths`.

        The paths are relative to the package's folder.
        """
        return {file.path for file in self.files}.issuperset(paths)


@dataclass(frozen=True)
class Submission:
    """The work of one student for one chapter: a notebook, packages that the chapter's parts need, or both.

    `problem` says why there is no notebook, or why the notebook cannot be graded.
    """

    student: str
    chapter: str  # An example is "05"; the chapter is empty if it is unknown.
    content: bytes = field(repr=False)  # `content` is the notebook, without data that grading does not need.
    origin: str  # `origin` is the path of the file in the submitted folder or archive.
    late: float = 0.0  # `late` is the number of days after the deadline.
    problem: str = ""
    notes: tuple[str, ...] = ()  # Each note describes something unusual about the submission.
    packages: tuple[Package, ...] = ()
    # `attempts` are the earlier attempts for this chapter.
    attempts: tuple[Submission, ...] = field(default=(), repr=False)

    @property
    def nothing(self) -> bool:
        """Whether the student's folder was empty."""
        return self.problem.startswith(NOTHING)

    @property
    def digest(self) -> str:
        """A digest of all files of the submission."""
        digest = hashlib.sha256(self.content)
        digest.update(b"\0" + self.chapter.encode() + b"\0" + self.problem.encode())
        for package in self.packages:
            for file in package.files:
                digest.update(repr((package.name, file)).encode("utf-8", "surrogatepass"))
        return digest.hexdigest()[:32]


@dataclass(frozen=True)
class CellOutcome:
    """The result of nbval for one cell of the notebook that is graded.

    The result is only feedback, and earns no points.
    """

    cell: str
    outcome: str  # The value is "passed", "failed" or "skipped".
    finding: str = ""  # `finding` is a sentence for the student, or "" for a cell that passed.
    line: str = ""  # `line` is the first line of the cell.


@dataclass(frozen=True)
class Flag:
    """A reason for the instructor to examine a student's work.

    Students never see a flag.
    """

    kind: str  # `kind` is the name of a module in flags/kinds, such as "copies".
    where: str  # `where` is the part, such as "05.1", or the path of a file.
    words: str  # `words` is a sentence about the reason for the flag.
    line: int = 0  # `line` is the line number in the cell or file, or 0 for the whole cell or file.
    evidence: str = ""  # `evidence` is the text of the line `line`.
    others: tuple[str, ...] = ()  # These students have a similar answer.


@dataclass(frozen=True)
class Grade:
    """The grade of one submission: a report for each part, in the order of the course's notebook."""

    student: str
    chapter: str
    reports: tuple[Report, ...]
    notes: tuple[str, ...] = ()  # Each note describes something unusual about the notebook.
    cells: tuple[CellOutcome, ...] = ()  # `cells` contains the result of each cell if nbval ran the notebook.
    sandboxed: bool = True  # `sandboxed` is False if the submission ran without a sandbox.
    late: float = 0.0  # The value is a number of days.
    factor: float = 1.0  # The points of a late submission are multiplied by this factor.
    key: str = ""  # `key` is a digest of the submission, the solution and the checks.
    origin: str = ""
    problem: str = ""  # `problem` is the reason why no part was examined, or "".
    # `code` contains the student's code of each examined part.
    code: dict[str, str] = field(default_factory=dict)
    private: tuple[str, ...] = ()  # Students see the points of these parts, but not the reports.
    handed_in: str = ""  # `handed_in` is the digest of the submission.
    flags: tuple[Flag, ...] = ()
    # `absent` is True if the grade is from an earlier run, and this run has no submission of the student for
    # the chapter.
    absent: bool = False

    @property
    def nothing(self) -> bool:
        """Whether the student's folder was empty."""
        return self.problem.startswith(NOTHING)

    @property
    def earned(self) -> float:
        """The points after the deduction for lateness."""
        return round(sum(report.points for report in self.reports) * self.factor, 2)

    @property
    def possible(self) -> float:
        """The maximum number of points."""
        return round(sum(report.possible for report in self.reports), 2)

    def unreviewed(self) -> Grade:
        """Return the grade with the points of the checks, without an instructor's points and comments."""
        return replace(self, reports=tuple(map(_unreviewed, self.reports)))

    def for_student(self) -> Grade:
        """Return the grade without flags, and without the goals, assertions and notes of private parts."""
        shown = (
            replace(report, goal="A further check.", assertions=(), goals=(), note="", printed="")
            if report.check in self.private
            else report
            for report in self.reports
        )
        code = {check: text for check, text in self.code.items() if check not in self.private}
        return replace(self, reports=tuple(shown), code=code, flags=())

    def as_dict(self) -> dict[str, Any]:
        """Return the grade as data that can be stored as JSON."""
        return {**asdict(self), "reports": [report.as_dict() for report in self.reports]}


def _unreviewed(report: Report) -> Report:
    known = report.review
    points = report.points if known is None or known.computed is None else known.computed
    return replace(report, points=points, review=None)


def grade_from(data: dict[str, Any]) -> Grade:
    """Return the grade from `data`, the result of as_dict()."""
    known = {
        **data,
        "reports": tuple(report_from(each) for each in data["reports"]),
        "cells": tuple(CellOutcome(**each) for each in data["cells"]),
        "notes": tuple(data["notes"]),
        "private": tuple(data["private"]),
        "flags": tuple(Flag(**{**each, "others": tuple(each["others"])}) for each in data.get("flags", ())),
    }
    return Grade(**known)
