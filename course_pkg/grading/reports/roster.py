"""The section of the reports about the roster.

The section lists missing students, unknown students, and students who were not identified.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import attrgetter

from course_pkg.grading import clean
from course_pkg.grading.reports.gradebook import Book, name_of
from course_pkg.grading.reports.page import paragraph, table, text
from course_pkg.grading.roster.people import FIELDS, Person

MISSING = "This student is on the roster, but handed in nothing."
STRANGER = "This student is not on the roster."
UNLISTED = "This student is not in Moodle's worksheet."
values = attrgetter(*FIELDS)


def about_identity(book: Book, student: str) -> list[str]:
    """Return the reasons why a student was not found in the roster or in the worksheet."""
    known = book.class_list
    reason = known.unclear.get(student, "")
    return [
        *([STRANGER] if student in known.strangers else []),
        *([UNLISTED] if student in known.unlisted else []),
        *([f"This student was not identified: {reason}."] if reason else []),
    ]


def identity_cells(person: Person | None) -> list[str]:
    """Return cells for a table: name, id, email, username and section."""
    return [clean.cell(value) for value in values(person or Person())]


def lead(book: Book) -> str:
    """Return a sentence about the roster for the top of class.html, or "" if there is no roster."""
    known = book.class_list
    return (
        f"{known.found} of {len(known.roster)} students on the roster handed in their work."
        if known.roster
        else ""
    )


def section(book: Book) -> Iterator[str]:
    """Yield the section of class.html about the roster; without a roster or a worksheet, yield nothing."""
    known = book.class_list
    if not known.given:
        return
    yield "<h2>Roster</h2>"
    rows = [_row(person, MISSING) for person in known.missing]
    for student in filter(None, book.students):
        if reasons := about_identity(book, student):
            person = book.person(student) or Person()
            rows.append(_row(person, " ".join(reasons), student))
    if rows:
        head = ["Student", "Section", "Username, email, id", "What to look at"]
        yield table("Students who are missing or could not be identified", head, rows, 0)
    else:
        yield paragraph("Each submission belongs to exactly one row of the roster.")


def _row(person: Person, reason: str, student: str = "") -> Sequence[str]:
    name = name_of(student) if student else person.label
    page = f"feedback/{clean.file_name(student)}.html"
    first = f'<a href="{page}">{text(name)}</a>' if student else text(name)
    identity = ", ".join(filter(None, [person.username, person.email, person.id]))
    return [first, text(person.section), text(identity), text(reason, 600)]
