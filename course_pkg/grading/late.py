"""Lateness: how many days, from a table, and what they cost, from a policy."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Submission

POLICY = re.compile(
    r"(?P<percent>\d+(?:\.\d+)?)\s*%\s*(?:a|per|each)\s+day"
    r"(?:\s*,?\s*(?:at most|up to|for)?\s*(?P<days>\d+(?:\.\d+)?)\s*days?)?",
    re.IGNORECASE,
)
COLUMNS = (["student", "days"], ["student", "chapter", "days"])
LARGEST = 1_000_000  # bytes of a table


@dataclass(frozen=True)
class LatePolicy:
    """What lateness costs: `percent` of the points for each day begun; nothing is left after `days`."""

    percent: float = 0.0
    days: float = math.inf

    def factor(self, late: float) -> float:
        """Return what the points of a submission are multiplied by, `late` days after the deadline."""
        if late <= 0:
            return 1.0
        if late > self.days:
            return 0.0
        return round(max(0.0, 1.0 - math.ceil(late) * self.percent / 100.0), 6)


def late_policy(words: str) -> LatePolicy:
    """Return the policy in `words`, such as "10% a day, 3 days"; an empty text or "none" costs nothing."""
    if words.strip().lower() in ("", "none"):
        return LatePolicy()
    found = POLICY.fullmatch(words.strip())
    if not found or float(found["percent"]) > 100:
        raise GradingError(
            f"The late policy {words!r} is none: say it as '10% a day', or as '10% a day, 3 days' if nothing "
            "is left after the third."
        )
    return LatePolicy(float(found["percent"]), float(found["days"] or math.inf))


@dataclass(frozen=True)
class LateTable:
    """Days late, by (student, chapter); the chapter "" stands for all that a student has no other row for."""

    rows: Mapping[tuple[str, str], float]

    def days(self, student: str, chapter: str) -> float:
        """Return the days that this submission came late."""
        return self.rows.get((student, chapter), self.rows.get((student, ""), 0.0))

    def applied(self, submissions: Sequence[Submission]) -> list[Submission]:
        """Return the submissions with their lateness."""
        return [replace(each, late=self.days(each.student, each.chapter)) for each in submissions]

    def strangers(self, submissions: Sequence[Submission]) -> int:
        """Return how many students of the table handed nothing in: a slip in a name shows here."""
        return len({student for student, _ in self.rows} - {each.student for each in submissions})


def late_table(path: Path) -> LateTable:
    """Return the table in the CSV file at `path`, with the columns student,days or student,chapter,days."""
    lines = _lines(path)
    head = [name.strip().lower() for name in lines[0]] if lines else []
    if head not in COLUMNS:
        raise GradingError(
            f"{path.name}, line 1: the first line has to name the columns, which are student,days or "
            "student,chapter,days."
        )
    rows: dict[tuple[str, str], float] = {}
    for number, values in enumerate(lines[1:], 2):
        if any(value.strip() for value in values):
            where = f"{path.name}, line {number}"
            key, days = _row(where, dict(zip(head, values, strict=False)), len(values) == len(head))
            if key in rows:
                raise GradingError(
                    f"{where}: this student and chapter stand there twice; keep one of the two."
                )
            rows[key] = days
    return LateTable(rows)


def _lines(path: Path) -> list[list[str]]:
    """Return the rows, whichever of the three usual characters stands between the columns."""
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
        if len(content) > LARGEST:
            raise GradingError(f"{path.name} is larger than a table of late days can be ({LARGEST} bytes).")
        whole = content.decode("utf-8-sig")
        first = whole.partition("\n")[0]
        delimiter = max(",;\t", key=first.count)
        return list(csv.reader(io.StringIO(whole, newline=""), delimiter=delimiter, strict=True))
    except (OSError, ValueError, csv.Error) as error:
        raise GradingError(
            f"The table of late days {path.name} cannot be read: {error}. Save it as CSV in UTF-8."
        ) from error


def _row(where: str, values: Mapping[str, str], complete: bool) -> tuple[tuple[str, str], float]:
    """Return the key and the days of a row; a message quotes nothing, for a name may stand anywhere."""
    student, chapter = values.get("student", "").strip(), values.get("chapter", "").strip()
    if not complete or not student:
        raise GradingError(f"{where}: each row needs a student and a number of days, and nothing more.")
    if chapter and not re.fullmatch(r"\d{1,2}", chapter):
        raise GradingError(f"{where}: this is no chapter; write two digits, such as 05.")
    return (clean.identity(student), chapter.zfill(2) if chapter else ""), _days(where, values["days"])


def _days(where: str, written: str) -> float:
    try:
        days = float(written.strip().replace(",", "."))
    except ValueError:
        days = math.nan
    if not 0 <= days < 10_000:
        raise GradingError(f"{where}: this is no number of days; write 0 or more, such as 1.5.")
    return days
