"""The data of grading: the submissions, and the points that they earned.

All data can be stored as JSON and read again without a change. So a report needs only the records on disk.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from course_pkg.checking.report import Report, report_from
from course_pkg.sandbox.job import WorkFile

IN_PACKAGES = "Examined in the packages, not in the cells of the notebook"
NOTHING = "The student handed in nothing"  # the beginning of the problem of an empty folder
NO_TIME = "The time of handing in is not known, so this submission is treated as on time."


@dataclass(frozen=True)
class Package:
    """A catkin package that a student has handed in."""

    name: str
    files: tuple[WorkFile, ...] = field(repr=False)
    origin: str  # the path of its folder in the submitted folder or archive

    def has(self, paths: Iterable[str]) -> bool:
        """Return whether the package contains all files `paths`, which are relative to its folder."""
        return {file.path for file in self.files}.issuperset(paths)


@dataclass(frozen=True)
class Submission:
    """The work of one student for one chapter: a notebook, packages that its parts examine, or both.

    `problem` is the reason why there is no notebook, or why it cannot be graded.
    """

    student: str
    chapter: str  # such as "05"; empty if unknown
    content: bytes = field(repr=False)  # a notebook that contains only the data for grading
    origin: str  # the path of the file in the submitted folder or archive
    late: float = 0.0  # days after the deadline
    problem: str = ""
    notes: tuple[str, ...] = ()  # notes about an unusual form of the submission
    packages: tuple[Package, ...] = ()
    attempts: tuple[Submission, ...] = field(default=(), repr=False)  # the earlier attempts for this chapter

    @property
    def nothing(self) -> bool:
        """Whether it stands for an empty folder."""
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
    """The result of one cell of the rebuilt notebook in nbval; it is only feedback, and earns no points."""

    cell: str
    outcome: str  # "passed", "failed", "skipped"
    finding: str = ""  # a sentence for the student; empty for a cell that passed
    line: str = ""  # the first line of the cell, so that the student recognises the cell


@dataclass(frozen=True)
class Flag:
    """A reason for the instructor to look at a student's work; it changes no points.

    Students never see it.
    """

    kind: str  # a module in flags/kinds, such as "copies"
    where: str  # the part, such as "05.1", or the path of a file
    words: str  # a sentence
    line: int = 0  # of the cell or file; 0 if the flag is about all of it
    evidence: str = ""  # this line
    others: tuple[str, ...] = ()  # the students whose work is similar


@dataclass(frozen=True)
class Grade:
    """The grade of one submission: a report for each part of the reference, in its order."""

    student: str
    chapter: str
    reports: tuple[Report, ...]
    notes: tuple[str, ...] = ()  # notes about an unusual form of the notebook
    cells: tuple[CellOutcome, ...] = ()  # the results of the cells in nbval, if nbval was run
    sandboxed: bool = True  # False means that it was run without a sandbox
    late: float = 0.0  # days
    factor: float = 1.0  # the factor for the points of a late submission
    key: str = ""  # a digest of the submission, the reference and the checks
    origin: str = ""
    problem: str = ""  # the problem of the submission; if there is one, no part was examined
    code: dict[str, str] = field(default_factory=dict)  # the student's code of each part that was examined
    private: tuple[str, ...] = ()  # the parts whose points, but not their reports, students see
    handed_in: str = ""  # the digest of the submission
    flags: tuple[Flag, ...] = ()  # for the instructor only
    absent: bool = False  # whether this is a result of an earlier run without a submission in this run

    @property
    def nothing(self) -> bool:
        """Whether it stands for an empty folder."""
        return self.problem.startswith(NOTHING)

    @property
    def earned(self) -> float:
        """The points after the deduction for lateness."""
        return round(sum(report.points for report in self.reports) * self.factor, 2)

    @property
    def possible(self) -> float:
        """The points that could be earned."""
        return round(sum(report.possible for report in self.reports), 2)

    def unreviewed(self) -> Grade:
        """Return the grade with the points of the checks, without an instructor's points and comments."""
        return replace(self, reports=tuple(map(_unreviewed, self.reports)))

    def for_student(self) -> Grade:
        """Return the grade without flags, and without the data that show how a private part is examined."""
        shown = (
            replace(report, goal="A further check.", assertions=(), goals=(), note="", printed="")
            if report.check in self.private
            else report
            for report in self.reports
        )
        code = {check: text for check, text in self.code.items() if check not in self.private}
        return replace(self, reports=tuple(shown), code=code, flags=())

    def as_dict(self) -> dict[str, Any]:
        """Return the grade as plain data."""
        return {**asdict(self), "reports": [report.as_dict() for report in self.reports]}


def _unreviewed(report: Report) -> Report:
    known = report.review
    points = report.points if known is None or known.computed is None else known.computed
    return replace(report, points=points, review=None)


def grade_from(data: dict[str, Any]) -> Grade:
    """Return the grade from `data`, the result of `as_dict`."""
    known = {
        **data,
        "reports": tuple(report_from(each) for each in data["reports"]),
        "cells": tuple(CellOutcome(**each) for each in data["cells"]),
        "notes": tuple(data["notes"]),
        "private": tuple(data["private"]),
        "flags": tuple(Flag(**{**each, "others": tuple(each["others"])}) for each in data.get("flags", ())),
    }
    return Grade(**known)
