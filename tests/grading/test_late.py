"""Late days from a table, and what they cost."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.grade import Submission
from course_pkg.grading.late import late_policy, late_table


def _table(folder: Path, content: str | bytes) -> Path:
    path = folder / "late.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    ("words", "late", "factor"),
    [
        ("10% a day, 3 days", 0, 1.0),
        ("10% a day, 3 days", 0.1, 0.9),
        ("10% a day, 3 days", 1, 0.9),
        ("10% a day, 3 days", 3, 0.7),
        ("10% a day, 3 days", 3.5, 0.0),
        ("10 % per day, at most 3 days", 2, 0.8),
        ("10% A DAY", 9, 0.1),
        ("10% a day", 11, 0.0),
        ("33.3% each day", 1, 0.667),
        ("100% a day", 0.01, 0.0),
        ("", 9, 1.0),
        ("none", 9, 1.0),
    ],
)
def test_what_lateness_costs(words: str, late: float, factor: float) -> None:
    """Each day that has begun costs its share; after the last nothing is left, never less than nothing."""
    assert late_policy(words).factor(late) == pytest.approx(factor)


@pytest.mark.parametrize(
    "words", ["10", "10% an hour", "-10% a day", "110% a day", "10% a day, many days", "nan% a day"]
)
def test_a_policy_that_is_none(words: str) -> None:
    """It is refused, with an example."""
    with pytest.raises(GradingError, match="10% a day, 3 days"):
        late_policy(words)


def test_a_table_by_student(tmp_path: Path) -> None:
    """A row holds for every chapter; who has no row is in time."""
    table = late_table(_table(tmp_path, "student,days\ns01,2\ns02,0.5\n\n"))
    assert [table.days(each, "05") for each in ("s01", "s02", "s03")] == [2.0, 0.5, 0.0]


def test_a_row_for_a_chapter_is_nearer(tmp_path: Path) -> None:
    """It outranks the student's other row; "5" is chapter 05."""
    table = late_table(_table(tmp_path, "student,chapter,days\ns01,,1\ns01,5,3\n"))
    assert (table.days("s01", "05"), table.days("s01", "06")) == (3.0, 1.0)


def test_as_a_spreadsheet_saves_it(tmp_path: Path) -> None:
    """With a mark at the beginning, semicolons, a comma for the point, capitals, other line ends."""
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
        ("x" * 1_000_001, "larger"),
    ],
)
def test_a_broken_table(tmp_path: Path, content: str | bytes, words: str) -> None:
    """The message names the line and what is wrong with it, and not the student."""
    with pytest.raises(GradingError, match=words) as caught:
        late_table(_table(tmp_path, content))
    assert "secret" not in str(caught.value)


def test_no_table(tmp_path: Path) -> None:
    """A file that is not there is named."""
    with pytest.raises(GradingError, match=r"none\.csv"):
        late_table(tmp_path / "none.csv")


def test_lateness_goes_to_the_submissions(tmp_path: Path) -> None:
    """Each gets its own; and a student of the table who handed nothing in is counted."""
    table = late_table(_table(tmp_path, "student,days\ns01,2\ns99,1\n"))
    given = [Submission(name, "05", b"", "") for name in ("s01", "s02")]
    assert [each.late for each in table.applied(given)] == [2.0, 0.0]
    assert table.strangers(given) == 1
