"""Only the instructor's files contain flags."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.flags.finding import kind_names, title_of, wanted_kinds, with_flags
from course_pkg.grading.grade import Flag, grade_from
from course_pkg.grading.reports import read_grades, write_reports
from tests.grading.flags.classes import solutions, submission
from tests.grading.grades import NASTY, class_of

WORDS = "Something that only the instructor reads."
FOR_THE_INSTRUCTOR = {"class.html", "grades.csv", "results/s01/05.json", "results/s02/05.json"}


def _write(out: Path, *flags: Flag) -> None:
    first, second, third = class_of(3)
    write_reports([replace(first, flags=flags), replace(second, flags=flags[:1]), third], out)


def test_only_the_instructor_reads_flags(tmp_path: Path) -> None:
    """Feedback pages and files for platforms contain no flags."""
    _write(tmp_path, Flag("files", "05.1", WORDS, 3, "open('x')"))
    files = {str(path.relative_to(tmp_path)): path for path in tmp_path.rglob("*") if path.is_file()}
    assert {name for name, path in files.items() if WORDS in path.read_text("utf-8")} == FOR_THE_INSTRUCTOR


def test_students_with_similar_answers_are_linked(tmp_path: Path) -> None:
    """In class.html, a student's entry contains links to each similar student and to the feedback page."""
    first, second, third = class_of(3)
    grades = [
        replace(first, flags=(Flag("copies", "05.2", WORDS, 1, "x = 1", ("s02",)),)),
        replace(second, flags=(Flag("copies", "05.2", WORDS, 1, "y = 1", ("s01",)),)),
        third,
    ]
    write_reports(grades, tmp_path)
    page = (tmp_path / "class.html").read_text("utf-8")
    for student, other in (("s01", "s02"), ("s02", "s01")):
        assert f'<li id="copies-{student}"><a href="feedback/{student}.html">' in page
        assert f'<a href="#copies-{other}">{other}</a>' in page
    assert f"<h3>{title_of('copies')}</h3>" in page


def test_the_column_of_the_table(tmp_path: Path) -> None:
    """The table has a column with the flags of each student."""
    _write(tmp_path, Flag("files", "05.1", WORDS, 3), Flag("copies", "arm.py", WORDS, 0, "", ("s02",)))
    with (tmp_path / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        flags = [row["flags"] for row in csv.DictReader(file)]
    assert flags == [
        f"05.1, line 3: {WORDS} | 05 arm.py: {WORDS} (similar: s02)",
        f"05.1, line 3: {WORDS}",
        "",
    ]


def test_without_flags_there_is_no_section(tmp_path: Path) -> None:
    """Without flags, class.html has no section about flags."""
    _write(tmp_path)
    assert "<h2>Flags" not in (tmp_path / "class.html").read_text("utf-8")


def test_a_flag_with_a_harmful_line(tmp_path: Path) -> None:
    """The line in a flag contains no harmful characters."""
    _write(tmp_path, Flag(NASTY, NASTY, NASTY, 1, NASTY, (NASTY,)))
    assert "<script>alert" not in (tmp_path / "class.html").read_text("utf-8")


def test_the_record_keeps_flags(tmp_path: Path) -> None:
    """A grade's record contains its flags; a record without the field "flags" is also valid."""
    flag = Flag("copies", "05.2", WORDS, 1, "x = 1", ("s02", "s03"))
    _write(tmp_path, flag)
    assert read_grades(tmp_path)[0].flags == (flag,)
    data = class_of(1)[0].as_dict()
    del data["flags"]
    assert grade_from(data).flags == ()


def test_points_do_not_change() -> None:
    """A flag does not change the points."""
    grade = class_of(1)[0]
    flagged = replace(grade, flags=(Flag("files", "05.1", WORDS),))
    assert (flagged.earned, flagged.possible, flagged.for_student()) == (grade.earned, grade.possible, grade)


def test_the_option() -> None:
    """`--flags` selects kinds of flags, and an unknown kind is an error."""
    assert wanted_kinds(()) == kind_names() == ["copies", "files", "internals", "patches", "solution"]
    assert wanted_kinds(("files", "copies")) == ["copies", "files"]
    assert wanted_kinds(("none",)) == []
    with pytest.raises(
        GradingError, match=r"--flags does not know colour\. Use one or more of these values: copies,files,"
    ):
        wanted_kinds(("colour",))


def test_the_grade_of_an_earlier_run_keeps_its_flags() -> None:
    """If the student has not submitted again, the flags of the earlier grade do not change."""
    flag = Flag("files", "05.1", WORDS)
    grade = replace(class_of(1)[0], flags=(flag,))
    assert with_flags([grade], [], ["files"]) == [grade]
    again = submission(grade.student, {}, origin=grade.origin)
    assert with_flags([grade], [again], ["files"])[0].flags == ()


def test_an_attempt_that_does_not_count() -> None:
    """Two similar attempts of the same student get no flag."""
    grade = class_of(1)[0]
    attempts = [submission(grade.student, solutions("05"), origin=place) for place in (grade.origin, "other")]
    assert with_flags([grade], attempts, ["copies"])[0].flags == ()
