"""Tests of submission times in files of Moodle, Gradescope and nbgrader."""

from __future__ import annotations

from datetime import datetime, timezone, tzinfo
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.moments import zone_of
from course_pkg.grading.deadlines.times import times_of
from course_pkg.grading.intake.submissions import submissions
from tests.grading.handing_in import NAMES, folder, handed_out, raw, zipped
from tests.grading.packages import my_geometry, write_package

NOTEBOOK = raw(handed_out())
FILE = NAMES["05"]
WORKSHEET = (
    "\ufeffIdentifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments\r\n"
    "Participant 17,A One,one@x.org,Submitted for grading - ,,10.00,Yes,"
    '"Sunday, 1 November 2026, 11:59 PM",-,\r\n'
    "Participant 18,A Two,two@x.org,No submission - ,,10.00,Yes,-,-,\r\n"
)
METADATA = """---
submission_456:
  :submitters:
  - :name: A One
    :sid: '17'
    :email: one@x.org
  - :name: A Two
    :sid: '18'
    :email: two@x.org
  :created_at: 2026-11-01 22:59:00.123456000 Z
  :score: 0.0
  :status: processed
submission_457:
  :submitters:
  - :name: A Three
    :sid: '19'
    :email: three@x.org
  :score: 0.0
"""


def _times(source: Path, option: str = "", zone: tzinfo | None = None) -> dict[str, str]:
    when = times_of(option, source, zone)
    found = {each.student: when(each) for each in submissions(source)}
    return {student: _utc(moment) for student, moment in found.items()}


def _utc(moment: datetime | None) -> str:
    return f"{moment.astimezone(timezone.utc):%Y-%m-%d %H:%M}" if moment else ""


def test_the_worksheet_of_moodle(tmp_path: Path) -> None:
    """The number in the folder's name selects the row of Moodle's worksheet."""
    names = [f"{name}_assignsubmission_file_/{FILE}" for name in ("A One_17", "A Two_18", "A Three_19")]
    source = folder(tmp_path / "in", dict.fromkeys(names, NOTEBOOK))
    table = tmp_path / "worksheet.csv"
    table.write_text(WORKSHEET, "utf-8", newline="")
    found = _times(source, str(table), zone_of("Europe/Berlin"))
    assert found == {"A One_17": "2026-11-01 22:59", "A Two_18": "", "A Three_19": ""}
    with pytest.raises(GradingError, match=r"line 2: the time has no time zone.*--time-zone"):
        times_of(str(table), source, None)


@pytest.mark.parametrize("pack", [False, True])
def test_gradescope(tmp_path: Path, pack: bool) -> None:
    """Gradescope's metadata contain the times, and all members of a group get the same time."""
    files = {
        f"assignment_9_export/submission_456/{FILE}": NOTEBOOK,
        f"assignment_9_export/submission_457/{FILE}": NOTEBOOK,
        "assignment_9_export/submission_456/submission_metadata.yml": b"submission_457: {':created_at': x}",
        "assignment_9_export/submission_metadata.yml": METADATA.encode(),
    }
    source = zipped(tmp_path / "export.zip", files) if pack else folder(tmp_path / "in", files)
    found = _times(source)
    assert {student: found[student] for student in ("17", "18", "19")} == {
        "17": "2026-11-01 22:59",
        "18": "2026-11-01 22:59",
        "19": "",
    }


@pytest.mark.parametrize("outer", ["", "submitted/"])
def test_nbgrader(tmp_path: Path, outer: str) -> None:
    """`course grade` reads the file timestamp.txt only with the option `--times nbgrader`."""
    files = {
        f"{outer}s01/ps1/{FILE}": NOTEBOOK,
        f"{outer}s01/ps1/timestamp.txt": b"2026-11-01 22:59:30.123456 UTC",
        f"{outer}s02/ps1/deep/{FILE}": NOTEBOOK,
        f"{outer}s02/ps1/deep/timestamp.txt": b"2020-01-01 00:00:00.000000 UTC",
        f"{outer}s03/ps1/{FILE}": NOTEBOOK,
    }
    source = folder(tmp_path, files)
    (source / outer / "s03/ps1/timestamp.txt").symlink_to(source / outer / "s01/ps1/timestamp.txt")
    assert _times(source, "nbgrader") == {"s01": "2026-11-01 22:59", "s02": "", "s03": ""}
    assert set(_times(source).values()) == {""}


def test_a_table_of_the_instructor(tmp_path: Path) -> None:
    """If the table has a row for the submitted file, the time comes from this row.

    If the table has no row for the file, the time comes from the row for the chapter. If the table has no row
    for the chapter either, the time comes from the row for the student.
    """
    source = folder(tmp_path / "in", {f"{name}/{FILE}": NOTEBOOK for name in ("s01", "s02", "s03", "s04")})
    table = tmp_path / "times.csv"
    table.write_text(
        "student,chapter,file,submitted\n"
        "s01,,,2026-11-01T10:00Z\n"
        "s02,,,2026-11-01T10:00Z\ns02,5,,2026-11-02 12:00 +01:00\ns02,06,,2026-11-03T10:00Z\n"
        f"s03,05,,2026-11-01T10:00Z\ns03,05,s03/{FILE},2026-11-04T10:00Z\n"
    )
    days = {student: text[8:13] for student, text in _times(source, str(table)).items()}
    assert days == {"s01": "01 10", "s02": "02 11", "s03": "04 10", "s04": ""}


def test_the_table_of_collected_files(tmp_path: Path) -> None:
    """The times come from the table times.csv next to the students' folders."""
    source = folder(
        tmp_path, {"s01/07_build_a_package.ipynb": raw(handed_out("07")), f"s02/{FILE}": NOTEBOOK}
    )
    write_package(source, "s01/my_geometry", my_geometry())
    (source / "times.csv").write_text(
        "student,chapter,file,time\n"
        "s01,07,07_build_a_package.ipynb,2026-11-01T10:00:00+00:00\n"
        "s01,07,my_geometry,2026-11-01T12:00:00+00:00\n"
        "s02,05,s02/other.ipynb,2026-11-01T13:00:00+00:00\n"
    )
    when = times_of("", source, None)
    found = {(each.student, each.chapter): _utc(when(each)) for each in submissions(source, ["05", "07"])}
    assert found["s01", "07"] == "2026-11-01 12:00"
    assert found["s02", "05"] == ""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Teilnehmer,Zuletzt geändert (Abgabe)\n", "switch Moodle to English"),
        ("student,days\n", "student,submitted"),
        ("student,submitted\nsecret,soon\n", "line 2: this is not a time"),
        ("student,submitted\n,2026-11-01T10:00Z\n", "line 2: the student is missing"),
        ("student,chapter,submitted\nsecret,five,2026-11-01T10:00Z\n", "line 2: .*chapter is not a number"),
        ("student,submitted\nsecret,2026-11-01T10:00Z\nsecret,2026-11-01T10:00Z\n", "line 3: .*twice"),
        ("student,submitted\nsecret,2026-11-01T10:00\n", "line 2: the time has no time zone"),
    ],
)
def test_a_broken_table_of_times(tmp_path: Path, text: str, said: str) -> None:
    """If the table is wrong, the error message contains the line number, but no student's name."""
    table = tmp_path / "times.csv"
    table.write_text(text, "utf-8")
    with pytest.raises(GradingError, match=said) as caught:
        times_of(str(table), tmp_path, None)
    assert "secret" not in str(caught.value)
    with pytest.raises(GradingError, match=r"table of times none\.csv cannot be read"):
        times_of(str(tmp_path / "none.csv"), tmp_path, None)
