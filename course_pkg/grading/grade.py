"""What grading is about, as plain data: what was handed in, and what it earned.

Everything here goes through JSON unchanged: a record on the disk is all that a report needs.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from typing import Any

from course_pkg.examiner.report import Report, report_from


@dataclass(frozen=True)
class Submission:
    """One notebook of one student, as it was handed in; `problem` says why it cannot be taken as one."""

    student: str
    chapter: str  # such as "05"; empty where nothing tells it
    content: bytes = field(repr=False)  # a notebook; nothing in it that grading does not look at
    origin: str  # the file's path inside what was handed in
    late: float = 0.0  # days after the deadline
    problem: str = ""
    notes: tuple[str, ...] = ()  # what was out of the ordinary about how it was handed in


@dataclass(frozen=True)
class CellOutcome:
    """How one cell of the rebuilt notebook went in nbval's run; this is feedback, and earns nothing."""

    cell: str
    outcome: str  # "passed", "failed", "skipped"
    words: str = ""


@dataclass(frozen=True)
class Grade:
    """What one submission earned: a report a part, in the order of the reference, none left out."""

    student: str
    chapter: str
    reports: tuple[Report, ...]
    notes: tuple[str, ...] = ()  # what was out of the ordinary about the notebook
    cells: tuple[CellOutcome, ...] = ()  # nbval's run, where there was one
    walls: bool = True  # False: it was run with nothing around it
    late: float = 0.0  # days
    factor: float = 1.0  # of the points, for being late
    key: str = ""  # of submission, reference and checks
    origin: str = ""
    problem: str = ""  # the submission's, where there was one: then nothing was examined
    private: tuple[str, ...] = ()  # parts of which students see the points alone

    @property
    def earned(self) -> float:
        """The points, lateness taken off."""
        return round(sum(report.points for report in self.reports) * self.factor, 2)

    @property
    def possible(self) -> int:
        """The points that there were to earn."""
        return sum(report.possible for report in self.reports)

    def for_student(self) -> Grade:
        """Return the grade with nothing in it that would tell how a private part is examined."""
        shown = (
            replace(report, goal="A further check.", rules=(), note="", printed="")
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
