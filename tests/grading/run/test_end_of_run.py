"""Tests of the output at the end of a grading run."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import pytest

from course_pkg.checking.report import Verdict
from course_pkg.grading.grade import NO_TIME, NOTHING, Grade
from course_pkg.grading.run.changes import changes, described, write_changes
from course_pkg.grading.run.summary import GRADED, NEED_A_LOOK, about_empty, about_rest, last_line, status_of
from tests.grading.grades import nasty, refused, report


def _grade(student: str, *verdicts: Verdict, **more: object) -> Grade:
    reports = tuple(report(f"05.{number}", verdict) for number, verdict in enumerate(verdicts, 1))
    return replace(Grade(student, "05", reports, origin=student), **more)  # type: ignore[arg-type]


FULL = _grade("s01", Verdict.PASSED, Verdict.PASSED)
LESS = _grade("s01", Verdict.PASSED, Verdict.FAILED)


def test_points_before_and_after() -> None:
    """Each changed part has a line with the student, the part, the old points and the new points."""
    assert list(map(str, changes([LESS], [FULL]))) == ["s01, 05.2: 0 before, 2 now"]
    assert changes([FULL], [FULL]) == []


def test_parts_that_only_one_run_has() -> None:
    """If a part was added or removed, the output contains this change."""
    shorter = replace(FULL, reports=FULL.reports[:1])
    assert list(map(str, changes([shorter], [FULL]))) == ["s01, 05.2: none before, 2 now"]
    assert list(map(str, changes([FULL], [shorter]))) == ["s01, 05.2: 2 before, none now"]


def test_lateness_alone() -> None:
    """If only the late days have changed, one line shows the old and the new points of the chapter."""
    late = replace(FULL, late=1.0, factor=0.5)
    assert list(map(str, changes([FULL], [late]))) == ["s01, chapter 05: 4 before, 2 now"]


def test_a_new_student_is_no_change() -> None:
    """If a submission has no earlier result, the output does not contain a change."""
    assert changes([FULL], [replace(LESS, student="s02")]) == []


def test_many_changes_are_in_the_file(tmp_path: Path) -> None:
    """The terminal shows the first 40 changes, and changes.csv contains all changes."""
    before = [replace(LESS, student=f"=s{number:03}") for number in range(60)]
    after = [replace(FULL, student=f"=s{number:03}") for number in range(60)]
    found = changes(before, after)
    lines = described(found, tmp_path)
    assert (len(lines), lines[-1]) == (42, f"  20 more changes are in {tmp_path / 'changes.csv'}.")
    write_changes(found, tmp_path)
    with (tmp_path / "changes.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 60
    assert rows[0] == {
        "student": "'=s000",
        "chapter": "05",
        "part": "05.2",
        "points before": "0",
        "points now": "2",
    }


def test_a_name_cannot_control_the_terminal(tmp_path: Path) -> None:
    """A line about a student contains no control characters."""
    student = nasty().student
    found = changes([replace(LESS, student=student)], [replace(FULL, student=student)])
    assert all(line.isprintable() for line in described(found, tmp_path))


@pytest.mark.parametrize(
    ("grades", "line", "status"),
    [
        ([FULL, LESS], "2 graded, 0 need a look", GRADED),
        ([FULL, refused(), refused("s32")], "1 graded, 2 need a look", NEED_A_LOOK),
        ([_grade("s01", Verdict.PASSED, Verdict.UNDECIDED)], "0 graded, 1 needs a look", NEED_A_LOOK),
        ([_grade("s01", Verdict.FAILED)], "0 graded, 1 needs a look", NEED_A_LOOK),
        ([replace(FULL, notes=(NO_TIME,))], "0 graded, 1 needs a look", NEED_A_LOOK),
    ],
)
def test_the_last_line_and_the_status(grades: list[Grade], line: str, status: int) -> None:
    """The last line contains the number of submissions that an instructor must check."""
    assert (last_line(grades), status_of(grades)) == (line, status)


def test_empty_folders_are_named() -> None:
    """The message lists at most ten students with an empty folder."""
    empty = [refused(f"s{number:02}", "", f"{NOTHING}: the folder is empty.") for number in range(12)]
    (line,) = about_empty([FULL, *empty])
    assert "s00, s01, " in line
    assert line.endswith("s09 and 2 more.")
    assert about_empty([FULL, refused()]) == []


def test_results_that_stay(tmp_path: Path) -> None:
    """The output lists the students without a new submission."""
    marked, kept = about_rest([replace(FULL, absent=True), replace(FULL, student="s02")], tmp_path)
    assert "s01 (chapter 05)" in marked
    assert kept == f"1 other result in {tmp_path} did not change."
