"""Tests of the search for a submission's student in the roster."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.grading.roster.class_list import ClassList, Lists, Origins
from course_pkg.grading.roster.people import Person

JANE = Person("Jane Doe", "17", "jane@uni.example", "jdoe", "A", line=2)
MAX = Person("Müller, Max Ernst", "18", "max@uni.example", "mmueller", "B", line=3)
ANN = Person("Ann Lee", "19", "ann1@uni.example", "alee1", "A", line=4)
ANN_TOO = Person("Ann Lee", "20", "ann2@uni.example", "alee2", "B", line=5)
ROSTER = (JANE, MAX, ANN, ANN_TOO)


def _matched(origins: Origins, roster: tuple[Person, ...] = ROSTER) -> ClassList:
    return Lists(roster=roster).matched(origins, Path("nowhere"))


@pytest.mark.parametrize(
    ("student", "origin"),
    [
        ("jdoe", "jdoe/05.ipynb"),
        ("JDoe", "JDoe/05.ipynb"),
        ("jane@uni.example", "jane@uni.example/05.ipynb"),
        ("17", "17/05.ipynb"),
        ("Jane Doe", "Jane Doe/05.ipynb"),
        ("Doe, Jane", "Doe, Jane/05.ipynb"),
        ("Jane_Doe", "Jane_Doe/05.ipynb"),
        ("doejane_17", "doejane_17_99_05.ipynb"),
        ("somebodyelse_17", "somebodyelse_LATE_17_99_05.ipynb"),
        ("Jane Doe_4711", "Jane Doe_4711_assignsubmission_file_/05.ipynb"),
    ],
)
def test_who_is_found(student: str, origin: str) -> None:
    """A submission is named after the student's user name, address, id or name, with or without a number."""
    found = _matched({student: [origin]})
    assert found.people[student].line == JANE.line
    assert (found.found, found.strangers, found.unclear) == (1, (), {})
    assert found.missing == (MAX, ANN, ANN_TOO)


@pytest.mark.parametrize("name", ["Max Ernst Müller", "muller, max ernst", "Mu\u0308ller Max Ernst"])
def test_names_in_any_order_and_with_any_accents(name: str) -> None:
    """The order of a student's names and the accents do not matter."""
    assert _matched({name: [f"{name}/05.ipynb"]}).people[name].username == "mmueller"


def test_two_students_with_one_name() -> None:
    """If a name is in two rows of the roster, the program reports that the student's row is unclear."""
    found = _matched({"Ann Lee": ["Ann Lee/05.ipynb"]})
    assert "Ann Lee" not in found.people
    assert found.unclear == {"Ann Lee": "several rows fit the student of the roster (lines 4 and 5)"}
    assert found.missing == (JANE, MAX)


def test_a_number_decides_between_two_students_with_one_name() -> None:
    """The Canvas user id in the file name selects one of two students with the same name."""
    found = _matched({"leeann_20": ["leeann_20_99_05.ipynb"]})
    assert found.people["leeann_20"].username == "alee2"
    assert found.unclear == {}


def test_parts_that_contradict_each_other() -> None:
    """If the number and the name of a folder fit different students, the folder is reported as unclear."""
    found = _matched({"doejane_18": ["doejane_18_99_05.ipynb"]})
    assert "different rows of the roster (lines 2 and 3)" in found.unclear["doejane_18"]
    assert found.people["doejane_18"] == Person("doejane", "18")


def test_a_number_of_moodle_is_no_id() -> None:
    """Moodle's participant number is not compared with the ids in the roster."""
    found = _matched({"Jo New_18": ["Jo New_18_assignsubmission_file_/05.ipynb"]})
    assert (found.strangers, found.unclear) == (("Jo New_18",), {})


def test_a_roster_with_the_numbers_of_moodle() -> None:
    """If two students have the same name, Moodle's number in the roster selects one of the students."""
    found = _matched({"Ann Lee_20": ["Ann Lee_20_assignsubmission_file_/05.ipynb"]})
    assert found.people["Ann Lee_20"].username == "alee2"


def test_two_folders_of_one_student() -> None:
    """If two folders belong to the same row of the roster, the program reports both folders as unclear."""
    found = _matched({"jdoe": ["jdoe/05.ipynb"], "Jane Doe": ["Jane Doe/05.ipynb"]})
    assert found.unclear == {
        "jdoe": "the student fits the same row of the roster (line 2) as Jane Doe",
        "Jane Doe": "the student fits the same row of the roster (line 2) as jdoe",
    }
    assert JANE not in found.missing


def test_strangers_and_a_file_of_nobody() -> None:
    """The program reports a student who is not on the roster, and ignores a file without a student."""
    found = _matched({"s99": ["s99/05.ipynb"], "": ["05.ipynb"]})
    assert (found.strangers, found.missing) == (("s99",), ROSTER)


def test_the_summary() -> None:
    """The summary lists missing, unknown and unclear students."""
    origins = {name: [f"{name}/05.ipynb"] for name in ("jdoe", "mmueller", "Ann Lee", "s99")}
    assert list(_matched(origins).summary()) == [
        "Roster: 2 of 4 students handed in their work.",
        "1 is not on the roster: s99.",
        (
            "The student Ann Lee cannot be identified: several rows fit the student of the roster (lines 4 "
            "and 5)."
        ),
        (
            "canvas.csv and moodle.csv have no row for this student. Correct the roster, or the name of the "
            "student's folder, and type the same command again."
        ),
    ]
    many = tuple(Person(f"N{number}", line=number) for number in range(2, 32))
    assert list(_matched({}, many).summary())[1] == (
        "30 handed in nothing: N2; N3; N4; N5; N6; N7; N8; N9; N10; N11 and 20 more; "
        "class.html contains all names."
    )


def test_without_lists() -> None:
    """Without a roster, the names and numbers from the platforms identify the students."""
    found = Lists().matched({"doejane_17": ["doejane_17_99_05.ipynb"], "s01": ["s01/05.ipynb"]})
    assert found.people == {"doejane_17": Person("doejane", "17")}
    assert list(found.summary()) == []
    assert not found.given
