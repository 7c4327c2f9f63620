"""Tests of reading and writing overrides.csv."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.review.overrides import FILE, Override, read_overrides, save
from tests.grading.review.classes import class_of_four

HEAD = "student,chapter,part,points,comment,answer\n"
WRONG = [
    ("s09,05,Part 05.1,1,,", "line 2: there is no submission of the student s09"),
    ("s01,05,Part 05.9,1,,", "line 2: the submission has no part 05.9"),
    ("s01,05,05. Jan,1,,", "line 2: 05. Jan is not a part"),
    ("s01,06,05.1,1,,", "line 2: part 05.1 is not in chapter 06"),
    ("s01,05,05.1,2.5,,", "line 2: 2.5 points are more than the maximum of 2 points"),
    ("s01,05,05.1,-1,,", "line 2: -1 is not a number of points"),
    ("s01,05,05.1,01. Mai,,", "line 2: 01. Mai is not a number of points"),
    ('s01,05,05.1,1,"two\nlines",\ns01,5,5.1,1,,', "line 4: line 2 has the same student and part"),
    ('s01,05,05.1,1,"open', "line 2: unexpected end of data"),
]


def _read(folder: Path, content: str | bytes) -> None:
    data = content if isinstance(content, bytes) else content.encode()
    (folder / FILE).write_bytes(data)
    read_overrides(folder).require_parts(class_of_four())


@pytest.mark.parametrize(("row", "message"), WRONG)
def test_a_wrong_row_is_reported_with_its_line(tmp_path: Path, row: str, message: str) -> None:
    """If a row is wrong, the error message contains the line number, and overrides.csv does not change."""
    with pytest.raises(GradingError) as caught:
        _read(tmp_path, HEAD + row)
    assert message in str(caught.value)
    assert (tmp_path / FILE).read_bytes() == (HEAD + row).encode()


def test_other_encodings_and_columns(tmp_path: Path) -> None:
    """A wrong encoding, a missing column or a spreadsheet file leads to one error message."""
    with pytest.raises(GradingError, match="line 3: the text is not UTF-8"):
        _read(tmp_path, HEAD.encode() + b"s01,05,05.1,1,,\ns02,05,05.1,1,f\xfcr,\n")
    with pytest.raises(GradingError, match="line 1: the column points is missing"):
        _read(tmp_path, "student,chapter,part,comment,answer\n")
    with pytest.raises(GradingError, match="not a CSV file"):
        _read(tmp_path, b"PK\x03\x04")


def test_a_part_that_a_spreadsheet_may_have_changed(tmp_path: Path) -> None:
    """If the parts 15.1 and 15.10 both exist, the program refuses a row for 15.1.

    A spreadsheet changes the text 15.10 to 15.1.
    """
    (tmp_path / FILE).write_text(f"{HEAD}s01,05,5.1,1,,\n")
    grade = class_of_four()[0]
    read_overrides(tmp_path).require_parts([grade])
    tenth = grade.reports[0].__class__("05.10", grade.reports[0].verdict, possible=2)
    both = grade.__class__(grade.student, grade.chapter, (*grade.reports, tenth))
    with pytest.raises(GradingError, match=r"line 2: a spreadsheet may have changed 05\.10 to 05\.1"):
        read_overrides(tmp_path).require_parts([both])


def test_a_german_spreadsheet_keeps_its_form(tmp_path: Path) -> None:
    """In a file from a German spreadsheet, new rows have semicolons and decimal commas too."""
    before = "\ufeffstudent;chapter;part;note;points;comment;answer\r\ns01;5;5.1;mine;1,5;gut;\r\n\r\n"
    _read(tmp_path, before)
    current = read_overrides(tmp_path)
    assert current.rows == {("s01", "05.1"): Override("s01", "05.1", 1.5, "gut")}
    new = Override("=evil", "05.1", 0.25, "=1+1; two\nlines", "v1")
    saved = save(current, {new.key: new})
    text = (tmp_path / FILE).read_bytes().decode()
    assert text.startswith(before)
    assert text.endswith("'=evil;05;Part 05.1;;0,25;\"'=1+1; two\nlines\";v1\r\n")
    assert saved.rows[new.key] == new
    assert list(save(saved, {("s01", "05.1"): None}).rows) == [new.key]
