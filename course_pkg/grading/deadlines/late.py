"""Reads a table of late days, and computes the deduction of points from options of `course grade`."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import NO_TIME, Submission
from course_pkg.grading.tables import table_rows

COLUMNS = (["student", "days"], ["student", "chapter", "days"])
LARGEST = 1_000_000  # LARGEST is the maximum number of bytes of a table.


@dataclass(frozen=True)
class LatePolicy:
    """The deduction for lateness: `per_day` percent of the points for each day that has begun.

    A submission that is more than `max_days` days late gets no points.
    """

    per_day: float = 0.0
    max_days: float = math.inf

    def factor(self, late: float) -> float:
        """Return the factor for the points of a late submission; `late` is the number of days."""
        if late <= 0:
            return 1.0
        if late > self.max_days:
            return 0.0
        return round(max(0.0, 1.0 - math.ceil(late) * self.per_day / 100.0), 6)


def late_policy(
    table: Path | None, per_day: float | None, max_days: float | None, deadlines: Sequence[str] = ()
) -> LatePolicy:
    """Return the policy from the options --late-per-day (percent) and --late-max-days.

    Raises GradingError if a number is out of range. Also raises GradingError for a policy without `table` and
    `deadlines`, and for `table` or `deadlines` without a policy.
    """
    if (table or deadlines) and per_day is None and max_days is None:
        raise GradingError(
            f"{'--late' if table else '--deadline'} needs a policy for late work. Give "
            "--late-per-day PERCENT, --late-max-days N, or both. For example, with --late-per-day "
            "10 --late-max-days 3, each late day costs 10 % of the points, and after 3 days no "
            "points are left. With --late-per-day 0, late work loses no points, but "
            "the reports say that the work was late."
        )
    if not table and not deadlines and (per_day is not None or max_days is not None):
        raise GradingError(
            "A late policy needs a deadline (--deadline TIME) or a table of late days (--late TABLE)."
        )
    if per_day is not None and not 0 <= per_day <= 100:
        raise GradingError(f"--late-per-day {per_day:g} is not a percentage. Give a number from 0 to 100.")
    if max_days is not None and not 0 <= max_days < math.inf:
        raise GradingError(
            f"--late-max-days {max_days:g} is not a number of days. Give a number of at least 0."
        )
    return LatePolicy(per_day or 0.0, math.inf if max_days is None else max_days)


@dataclass(frozen=True)
class LateTable:
    """How many days late each submission is; the keys are (student, chapter).

    A row with the chapter "" applies to each chapter for which the student has no other row.
    """

    rows: Mapping[tuple[str, str], float]

    def days(self, student: str, chapter: str) -> float:
        """Return the number of days by which a student's submission for a chapter is late."""
        return self.rows.get((student, chapter), self.rows.get((student, ""), 0.0))

    def applied(self, submissions: Sequence[Submission]) -> list[Submission]:
        """Return the submissions; for a submission in the table, the late days come from the table."""
        return [
            self._late(each)
            if (each.student, each.chapter) in self.rows or (each.student, "") in self.rows
            else each
            for each in submissions
        ]

    def _late(self, submission: Submission) -> Submission:
        notes = tuple(note for note in submission.notes if note != NO_TIME)
        return replace(submission, late=self.days(submission.student, submission.chapter), notes=notes)

    def strangers(self, submissions: Sequence[Submission]) -> int:
        """Return how many students in the table have no submission; their names may be misspelt."""
        return len({student for student, _ in self.rows} - {each.student for each in submissions})


def late_table(path: Path) -> LateTable:
    """Return the table in a CSV file with the columns student,days or student,chapter,days."""
    lines = table_rows(path, "table of late days")
    head = [name.strip().lower() for name in lines[0]] if lines else []
    if head not in COLUMNS:
        raise GradingError(
            f"{path.name}, line 1: the first line has to contain the names of the columns. Write "
            "student,days or student,chapter,days."
        )
    rows: dict[tuple[str, str], float] = {}
    for number, values in enumerate(lines[1:], 2):
        if any(value.strip() for value in values):
            where = f"{path.name}, line {number}"
            key, days = _row(where, dict(zip(head, values, strict=False)), len(values) == len(head))
            if key in rows:
                raise GradingError(
                    f"{where}: this student and chapter are in the table twice. Keep only one of the "
                    "two rows."
                )
            rows[key] = days
    return LateTable(rows)


def _row(where: str, values: Mapping[str, str], complete: bool) -> tuple[tuple[str, str], float]:
    """Return the key (student, chapter) and the number of late days in a row.

    An error message never contains a cell, because a cell can contain a student's name.
    """
    student, chapter = values.get("student", "").strip(), values.get("chapter", "").strip()
    if not complete or not student:
        raise GradingError(
            f"{where}: the student is missing, or the number of cells is wrong. Write one cell for each "
            "column."
        )
    if chapter and not re.fullmatch(r"\d{1,2}", chapter):
        raise GradingError(f"{where}: this is not a chapter. Write two digits, such as 05.")
    return (clean.identity(student), chapter.zfill(2) if chapter else ""), _days(where, values["days"])


def _days(where: str, written: str) -> float:
    try:
        days = float(written.strip().replace(",", "."))
    except ValueError:
        days = math.nan
    if not 0 <= days < 10_000:
        raise GradingError(
            f"{where}: this is not a number of days. Write a number of at least 0, such as 1.5."
        )
    return days
