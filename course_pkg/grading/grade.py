"""The data of grading: what was handed in, and which points it earned.

Everything here can be stored as JSON and read again unchanged, so a report needs only the records on disk.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from course_pkg.checking.report import Report, report_from
from course_pkg.sandbox.job import WorkFile


@dataclass(frozen=True)
class Package:
    """A catkin package of a student, as it was handed in."""

    name: str
    files: tuple[WorkFile, ...] = field(repr=False)
    origin: str  # its folder's path inside what was handed in

    def has(self, paths: Iterable[str]) -> bool:
        """Return whether all files `paths`, relative to the package, are in it."""
        return {file.path for file in self.files}.issuperset(paths)


@dataclass(frozen=True)
class Submission:
    """What one student handed in for one chapter: a notebook, packages that its parts examine, or both.

    `problem` says why the notebook cannot be graded, or that there is none.
    """

    student: str
    chapter: str  # such as "05"; empty if unknown
    content: bytes = field(repr=False)  # a notebook with only what grading needs
    origin: str  # the file's path inside what was handed in
    late: float = 0.0  # days after the deadline
    problem: str = ""
    notes: tuple[str, ...] = ()  # what was unusual about how it was handed in
    packages: tuple[Package, ...] = ()


@dataclass(frozen=True)
class CellOutcome:
    """How one cell of the rebuilt notebook ran in nbval; this is feedback and earns no points."""

    cell: str
    outcome: str  # "passed", "failed", "skipped"
    words: str = ""


@dataclass(frozen=True)
class Grade:
    """The grade of one submission: a report for each part, in the order of the reference, without gaps."""

    student: str
    chapter: str
    reports: tuple[Report, ...]
    notes: tuple[str, ...] = ()  # what was unusual about the notebook
    cells: tuple[CellOutcome, ...] = ()  # the cells of nbval's run, if there was one
    sandboxed: bool = True  # False: it was run without a sandbox
    late: float = 0.0  # days
    factor: float = 1.0  # the factor for the points of a late submission
    key: str = ""  # of submission, reference and checks
    origin: str = ""
    problem: str = ""  # the problem of the submission, if there was one: then nothing was examined
    private: tuple[str, ...] = ()  # parts of which students see only the points

    @property
    def earned(self) -> float:
        """The points, after what lateness costs."""
        return round(sum(report.points for report in self.reports) * self.factor, 2)

    @property
    def possible(self) -> int:
        """The points that could be earned."""
        return sum(report.possible for report in self.reports)

    def for_student(self) -> Grade:
        """Return the grade without anything that shows how a private part is examined."""
        shown = (
            replace(report, goal="A further check.", assertions=(), note="", printed="")
            if report.check in self.private
            else report
            for report in self.reports
        )
        return replace(self, reports=tuple(shown))

    def as_dict(self) -> dict[str, Any]:
        """Return the grade as plain data."""
        return {**asdict(self), "reports": [report.as_dict() for report in self.reports]}


def grade_from(data: dict[str, Any]) -> Grade:
    """Return the grade that `data`, made by `as_dict`, describes."""
    known = {
        **data,
        "reports": tuple(report_from(each) for each in data["reports"]),
        "cells": tuple(CellOutcome(**each) for each in data["cells"]),
        "notes": tuple(data["notes"]),
        "private": tuple(data["private"]),
    }
    return Grade(**known)
