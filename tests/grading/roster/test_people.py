"""Tests of the reader for rosters from spreadsheets and platforms."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.roster.people import Person, labels, read_roster

JANE = Person("Jane Doe", "17", "jane@uni.example", "jdoe", "A", line=2)


def _file(folder: Path, content: str | bytes) -> Path:
    path = folder / "roster.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(
    "content",
    [
        "name,id,email,username,section\nJane Doe,17,jane@uni.example,jdoe,A\n",
        "section,username,email,id,name\nA,jdoe,jane@uni.example,17,Jane Doe\n",
        "\ufeffName;ID;E-Mail;User_Name;Sections\r\nJane Doe;17;jane@uni.example;jdoe;A\r\n",
        "name\tid\temail\tusername\tsection\n\nJane Doe\t17\tjane@uni.example\tjdoe\tA",
        "name,id,email,username,section\n Jane Doe , 17,jane@uni.example ,jdoe,A,,\n,,,,\n",
        "name;id;email;username;section\nJane Doe;17;jane@uni.example;jdoe;A\n".encode("utf-16"),
        "First Name,Last Name,SID,Email,Username,Sections\nJane,Doe,17,jane@uni.example,jdoe,A\n",
    ],
    ids=["as documented", "another order", "Excel", "tabs", "blanks", "UTF-16", "two columns for the name"],
)
def test_as_spreadsheets_and_platforms_save_it(tmp_path: Path, content: str | bytes) -> None:
    """A roster can have any column order, any separator and a byte order mark."""
    [person] = read_roster(_file(tmp_path, content))
    assert (person.name, person.id, person.email, person.username, person.section) == (
        *("Jane Doe", "17", "jane@uni.example"),
        *("jdoe", "A"),
    )


@pytest.mark.parametrize(
    ("content", "person"),
    [
        ("email\nj@x.example\n", Person(email="j@x.example", line=2)),
        ("id\n17\n", Person(id="17", line=2)),
        ("name,extension\nJane,3\n", Person("Jane", line=2, more={"extension": "3"})),
        ("name,id,section\nJane\n", Person("Jane", line=2)),
    ],
)
def test_columns_that_are_missing(tmp_path: Path, content: str, person: Person) -> None:
    """A roster needs only one column that identifies students."""
    assert read_roster(_file(tmp_path, content)) == (person,)


def test_an_export_of_canvas_is_a_roster(tmp_path: Path) -> None:
    """In Canvas's export, the program ignores the row of possible points and the test student."""
    content = (
        "Student,ID,SIS User ID,SIS Login ID,Section,Lab 1 (99)\n    Points Possible,,,,,9.0\n"
        '"Doe, Jane",17,S4,jdoe,ROS 2026,\n"Student, Test",18,,f00,ROS 2026,\n'
    )
    [jane] = read_roster(_file(tmp_path, content))
    assert (jane.name, jane.id, jane.username, jane.section) == ("Doe, Jane", "17", "jdoe", "ROS 2026")
    assert jane.more["sis user id"] == "S4"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "line 1: the first line has to contain the names of the columns"),
        ("secret,17\n", "line 1: the first line has to contain the names of the columns"),
        ("section\nsecret\n", "At least one of the first four is necessary"),
        ("name,id\n", "contains no student"),
        ("name,id,sid\nsecret,1,2\n", "line 1: columns 2 and 3 both contain the id"),
        ("name,id\nsecret,1\nother,1\n", "lines 2 and 3 have the same id"),
        ("name,email\na,Secret@x\nb,secret@X\n", "lines 2 and 3 have the same email"),
        ("username\nsecret\nother\nsecret\n", "lines 2 and 4 have the same username"),
        ("name,section\n,secret\n", "line 2: the student has no name, id, email or username"),
        ("name,id\nsecret,1,2\n", "line 2: there are 3 cells, but only 2 columns"),
        ('name,id\n"secret,1\n', "cannot be read.*Save the file as CSV in UTF-8"),
        (b"name\n\xff\n", "cannot be read.*UTF-8"),
        (b"PK\x03\x04secret", "spreadsheet and not a CSV file. Save the file as CSV"),
        ("x" * 1_000_001, "too large for a roster"),
    ],
)
def test_a_bad_roster(tmp_path: Path, content: str | bytes, message: str) -> None:
    """If the roster is wrong, the error message contains the mistake and its line, but no cell."""
    with pytest.raises(GradingError, match=message) as caught:
        read_roster(_file(tmp_path, content))
    assert "roster.csv" in str(caught.value)
    assert "secret" not in str(caught.value).lower()


def test_no_roster(tmp_path: Path) -> None:
    """If the roster is missing, the error message contains the name of the file."""
    with pytest.raises(GradingError, match=r"none\.csv cannot be read: No such file.*Correct the path"):
        read_roster(tmp_path / "none.csv")


def test_labels() -> None:
    """A student's label is the student's name.

    If two students have the same name, the label also contains the line number.
    """
    people = [JANE, Person(email="a@b.example", line=3), Person("Jane Doe", line=4)]
    assert list(labels(people)) == ["Jane Doe (line 2)", "a@b.example", "Jane Doe (line 4)"]
