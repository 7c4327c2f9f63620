"""Tests of the table of late days, and of the deduction of points."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.late import late_policy, late_table
from course_pkg.grading.grade import Submission


def _table(folder: Path, content: str | bytes) -> Path:
    path = folder / "late.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    ("per_day", "max_days", "late", "factor"),
    [
        (10, 3, 0, 1.0),
        (10, 3, 0.1, 0.9),
        (10, 3, 1, 0.9),
        (10, 3, 3, 0.7),
        (10, 3, 3.5, 0.0),
        (10, None, 9, 0.1),
        (10, None, 11, 0.0),
        (33.3, None, 1, 0.667),
        (100, None, 0.01, 0.0),
        (0, None, 9, 1.0),
        (None, 2, 2, 1.0),
        (None, 2, 2.5, 0.0),
    ],
)
def test_deduction_for_lateness(
    tmp_path: Path, per_day: float | None, max_days: float | None, late: float, factor: float
) -> None:
    """Each late day costs the given percentage of the points, up to the maximum number of days."""
    assert late_policy(tmp_path, per_day, max_days).factor(late) == pytest.approx(factor)


def test_without_a_table_no_submission_is_late() -> None:
    """Without a table of late days and without a deadline, no submission is late."""
    assert late_policy(None, None, None).factor(9) == 1.0


@pytest.mark.parametrize(
    ("table", "per_day", "max_days", "message"),
    [
        (Path("late.csv"), None, None, "--late needs a policy.*--late-per-day 10"),
        (None, 10, None, "--late TABLE"),
        (None, None, 3, "--late TABLE"),
        (Path("late.csv"), -10, None, "--late-per-day -10 .*0 to 100"),
        (Path("late.csv"), 110, None, "--late-per-day 110 .*0 to 100"),
        (Path("late.csv"), math.nan, None, "--late-per-day nan .*0 to 100"),
        (Path("late.csv"), 10, -1, "--late-max-days -1 .*at least 0"),
        (Path("late.csv"), 10, math.nan, "--late-max-days nan .*at least 0"),
    ],
)
def test_invalid_policy_is_refused(
    table: Path | None, per_day: float | None, max_days: float | None, message: str
) -> None:
    """If a setting is invalid, the error message contains the option and the expected value."""
    with pytest.raises(GradingError, match=message):
        late_policy(table, per_day, max_days)


def test_a_table_by_student(tmp_path: Path) -> None:
    """A row without a chapter applies to all chapters of the student."""
    table = late_table(_table(tmp_path, "student,days\ns01,2\ns02,0.5\n\n"))
    assert [table.days(each, "05") for each in ("s01", "s02", "s03")] == [2.0, 0.5, 0.0]


def test_row_for_a_chapter_replaces_the_general_row(tmp_path: Path) -> None:
    """A row for a chapter replaces the student's general row."""
    table = late_table(_table(tmp_path, "student,chapter,days\ns01,,1\ns01,5,3\n"))
    assert (table.days("s01", "05"), table.days("s01", "06")) == (3.0, 1.0)


def test_as_a_spreadsheet_saves_it(tmp_path: Path) -> None:
    """The table of late days can have a byte order mark, semicolons and decimal commas."""
    table = late_table(_table(tmp_path, "\ufeffStudent;Days\r\nGro\u0308ße;1,5\r\n".encode()))
    assert table.days("Größe", "05") == 1.5


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "line 1"),
        ("secret,days\n", "student,days"),
        ("student,days\nsecret\n", "line 2"),
        ("student,days\nsecret,1,2\n", "line 2"),
        ("student,days\n2,secret\n", "line 2.*number of days"),
        ("student,days\nsecret,-1\n", "line 2.*number of days"),
        ("student,days\nsecret,nan\n", "line 2.*number of days"),
        ("student,days\nsecret,inf\n", "line 2.*number of days"),
        ("student,days\nsecret,1\nsecret,1\n", "line 3.*twice"),
        ("student,chapter,days\nsecret,five,1\n", "line 2.*two digits"),
        ('student,days\n"secret,1\n', "cannot be read"),
        (b"student,days\n\xff,1\n", "UTF-8"),
        ("x" * 1_000_001, "too large"),
    ],
)
def test_a_broken_table(tmp_path: Path, content: str | bytes, words: str) -> None:
    """If the table is wrong, the error message contains the line and the mistake, but no student's name."""
    with pytest.raises(GradingError, match=words) as caught:
        late_table(_table(tmp_path, content))
    assert "secret" not in str(caught.value)


def test_no_table(tmp_path: Path) -> None:
    """If the table of late days is missing, the error message contains the name of the file."""
    with pytest.raises(GradingError, match=r"none\.csv"):
        late_table(tmp_path / "none.csv")


def test_lateness_goes_to_the_submissions(tmp_path: Path) -> None:
    """Each submission gets its student's number of late days from the table."""
    table = late_table(_table(tmp_path, "student,days\ns01,2\ns99,1\n"))
    given = [Submission(name, "05", b"", "") for name in ("s01", "s02")]
    assert [each.late for each in table.applied(given)] == [2.0, 0.0]
    assert table.strangers(given) == 1
