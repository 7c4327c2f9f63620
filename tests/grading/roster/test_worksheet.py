"""Tests of the grades that the course writes into a copy of Moodle's worksheet."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.roster.worksheet import Worksheet, read_worksheet
from tests.grading.roster.worksheets import ANONYMOUS, ENGLISH, FRENCH, GERMAN, SCALE, SPANISH

IDS = ["English", "German", "French", "Spanish", "anonymous"]


def _read(folder: Path, content: str | bytes) -> Worksheet:
    path = folder / "sheet.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_worksheet(path)


@pytest.mark.parametrize("content", [ENGLISH, GERMAN, FRENCH, SPANISH, ANONYMOUS], ids=IDS)
def test_an_unchanged_copy(tmp_path: Path, content: str) -> None:
    """Without grades, the copy has the same bytes as the original worksheet."""
    assert _read(tmp_path, content).copy({}) == content.encode()


@pytest.mark.parametrize(
    ("content", "grade", "written"),
    [(ENGLISH, 7, "7.5"), (GERMAN, 4, "7,5"), (FRENCH, 4, "7,5"), (SPANISH, 4, "7,5"), (ANONYMOUS, 2, "7.5")],
    ids=IDS,
)
def test_only_two_cells_change(tmp_path: Path, content: str, grade: int, written: str) -> None:
    """Only the grade and the feedback change, and the grade has the decimal separator of the worksheet."""
    worksheet = _read(tmp_path, content)
    first = worksheet.participants[0]
    separator = ";" if content is FRENCH else ","
    copy = worksheet.copy({first.place: ("7.5", 'a &lt; b, "c"')}).decode()
    before, after = (
        list(csv.reader(io.StringIO(text, newline=""), delimiter=separator)) for text in (content, copy)
    )
    expected = before[1].copy()
    expected[grade] = written
    if worksheet.takes_feedback:
        expected[-1] = 'a &lt; b, "c"'
    assert after == [before[0], expected, *before[2:]]
    head, rest = content.split("\n", 1)
    assert copy.startswith(head + "\n")
    assert copy.count("\r\n") == content.count("\r\n")
    assert copy.endswith(rest[-60:] if len(worksheet.participants) > 1 else copy[-1:])


@pytest.mark.parametrize(
    ("content", "maxima", "locked"),
    [
        (ENGLISH, [100, 100, 100, 100], [False, False, False, True]),
        (GERMAN, [10, 10], [False, False]),
        (FRENCH, [20], [False]),
        (SPANISH, [9], [False]),
        (ANONYMOUS, [None], [False]),
        (GERMAN.replace('"10,00","Ja"', '"1.000,00","Nein"'), [1000, 1000], [True, True]),
    ],
)
def test_the_participants(
    tmp_path: Path, content: str, maxima: list[float | None], locked: list[bool]
) -> None:
    """The program reads the participants and their maximum grades from worksheets in each language."""
    found = _read(tmp_path, content).participants
    assert [each.maximum for each in found] == maxima
    assert [each.locked for each in found] == locked
    assert [each.person.number for each in found] == [str(101 + place) for place in range(len(found))]
    if content is not ANONYMOUS:
        assert (found[0].person.name, found[0].person.email) == ("Jane Doe", "jane@uni.example")
    if content is ENGLISH:
        assert [each.person.line for each in found] == [2, 4, 5, 6]
        assert found[0].person.id == "4711"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "does not contain Identifier and Grade.*Download grading worksheet"),
        ("name,points\nsecret,1\n", "does not contain Identifier and Grade"),
        ("Identifier,secret\nParticipant 1,\n", "does not contain Grade"),
        (SCALE, "graded with a scale.*Grade type to Point"),
        (ENGLISH.replace("100.00", "0.00", 1), "line 2: Moodle gives no points.*Grade type to Point"),
        (ENGLISH.replace("100.00", "secret", 1), "line 2: the maximum grade is not a number"),
        (ENGLISH.replace("Participant 103", "secret"), "line 5: the identifier does not end in a number"),
        (ENGLISH.replace("Participant 103", "Participant 101"), "lines 2 and 5 have the same identifier"),
        (ENGLISH.replace('"Ann Lee",', ""), "line 5: there are 14 cells, but 15 columns.*Download"),
        (GERMAN.encode("latin-1"), "not in UTF-8.*do not open it in a spreadsheet"),
        (b"PK\x03\x04", "spreadsheet and not a CSV file"),
    ],
)
def test_a_file_that_moodle_would_refuse(tmp_path: Path, content: str | bytes, message: str) -> None:
    """If a worksheet is wrong, the error message contains the mistake and its line, but no cell."""
    with pytest.raises(GradingError, match=message) as caught:
        _read(tmp_path, content)
    assert "sheet.csv" in str(caught.value)
    assert "secret" not in str(caught.value)
