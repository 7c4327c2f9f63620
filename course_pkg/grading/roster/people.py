"""The roster: the students of a class, from a CSV file.

The first line contains the names of the columns, in any order: name, id, email, username, section. At least
one of the columns name, id, email and username is required. The course also understands the columns of Canvas
(Student, ID, SIS Login ID, Section), Gradescope (First Name, Last Name, SID, Email, Sections) and Moodle
(First name, Last name, Email address, ID number, Username). Therefore, an export from one of these platforms
is a roster. The values of other columns are stored under the columns' names.
"""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.tables import table_rows

WHAT = "roster"
FIRST, LAST = "first name", "last name"
IDENTITY = ("id", "email", "username")  # Two students cannot have the same value in one of these fields.
FIELDS = ("name", *IDENTITY, "section")
ALIASES = {
    "name": ("name", "full name", "student", "student name"),
    FIRST: (FIRST, "firstname", "given name"),
    LAST: (LAST, "lastname", "surname", "family name"),
    "id": ("id", "student id", "id number", "sid", "canvas id", "canvas user id"),
    "email": ("email", "e-mail", "mail", "email address", "e-mail address"),
    "username": ("username", "user name", "login", "login id", "sis login id"),
    "section": ("section", "sections"),
}
# Canvas adds the two rows in NO_STUDENTS to each exported gradebook.
NO_STUDENTS = ("Points Possible", "Student, Test")


@dataclass(frozen=True)
class Person:
    """The data about a student from a roster or a platform; an unknown field is empty."""

    name: str = ""
    id: str = ""  # `id` is the Canvas user id, or Gradescope's student number (SID).
    email: str = ""
    username: str = ""
    section: str = ""
    number: str = ""  # `number` is Moodle's number of a participant in one assignment, such as "12345".
    line: int = 0  # `line` is the number of the line in the file, or 0 if the person is not from a file.
    # `more` contains the other columns; the keys are the columns' names in lower case.
    more: Mapping[str, str] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """A name for the person: the field `name`, or else another known field."""
        known = (self.name, self.username, self.email, self.id, self.number)
        return next(filter(None, known), f"line {self.line}")

    def completed(self, other: Person) -> Person:
        """Return a copy of this person; its empty fields have the values of `other`."""
        gaps = {key: getattr(other, key) for key in (*FIELDS, "number") if not getattr(self, key)}
        return replace(self, **gaps)


def read_roster(path: Path) -> tuple[Person, ...]:
    """Return the students in the CSV file at the path `path`, in the order of the file.

    Raises GradingError if the file cannot be read, if no column is known, if two columns have the same
    meaning, if a row has no identity, or if two rows have the same identity. An error message never contains
    a cell, because a cell can contain a student's name.
    """
    lines = table_rows(path, WHAT)
    head = [_plain(name) for name in lines[0]] if lines else []
    columns = _columns(path.name, head)
    people = []
    for number, values in enumerate(lines[1:], 2):
        cells = [_text(value) for value in values]
        if any(cells):
            people.append(_person(f"{path.name}, line {number}", number, head, columns, cells))
    people = [person for person in people if person.name not in NO_STUDENTS]
    if not people:
        raise GradingError(f"{path.name} contains no student. Write one line for each student.")
    _refuse_twice(path.name, people)
    return tuple(people)


def _columns(file: str, head: Sequence[str]) -> dict[str, int]:
    """Return the index of each known column."""
    found: dict[str, int] = {}
    for place, name in enumerate(head):
        for known, names in ALIASES.items():
            if name in names and found.setdefault(known, place) != place:
                raise GradingError(
                    f"{file}, line 1: columns {found[known] + 1} and {place + 1} both contain the "
                    f"{known}. Remove one of the two columns, or give it another name."
                )
    if not found.keys() - {"section"}:
        raise GradingError(
            f"{file}, line 1: the first line has to contain the names of the columns. Use name, id, "
            "email, username and section, in any order. At least one of the first four is "
            "necessary."
        )
    return found


def _person(
    where: str, line: int, head: Sequence[str], columns: Mapping[str, int], cells: Sequence[str]
) -> Person:
    if any(cells[len(head) :]):
        raise GradingError(
            f"{where}: there are {len(cells)} cells, but only {len(head)} columns. Put quotes around a cell "
            "that contains the separator."
        )
    padded = [*cells, *[""] * (len(head) - len(cells))]
    known = {name: padded[place] for name, place in columns.items()}
    name = known.get("name", "") or " ".join(filter(None, [known.get(FIRST, ""), known.get(LAST, "")]))
    fields = {key: known.get(key, "") for key in (*IDENTITY, "section")}
    if not name and not any(fields[key] for key in IDENTITY):
        raise GradingError(
            f"{where}: the student has no name, id, email or username. Add one of these values."
        )
    further = {name: padded[place] for place, name in enumerate(head) if place not in columns.values()}
    return Person(name, **fields, line=line, more=further)


def _refuse_twice(file: str, people: Sequence[Person]) -> None:
    """Raise GradingError if two students have the same id, email or username; equal names are allowed."""
    for key in IDENTITY:
        seen: dict[str, int] = {}
        for person in people:
            value = getattr(person, key).casefold()
            if value and seen.setdefault(value, person.line) != person.line:
                raise GradingError(
                    f"{file}: lines {seen[value]} and {person.line} have the same {key}. Correct or "
                    "remove one of the two lines."
                )


def _plain(name: str) -> str:
    return re.sub(r"[\s_]+", " ", _text(name)).casefold()


def _text(value: str) -> str:
    return clean.line(unicodedata.normalize("NFC", value), 200)


def labels(people: Sequence[Person]) -> Iterator[str]:
    """Yield a label for each person; if several persons have the same label, add the line number."""
    known = Counter(person.label for person in people)
    for person in people:
        yield f"{person.label} (line {person.line})" if known[person.label] > 1 else person.label
