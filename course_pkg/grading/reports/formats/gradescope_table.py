"""gradescope.csv has the same layout as the file of grades that an instructor can download from Gradescope.

Gradescope's file (menu Review Grades, Download Grades) has the columns Name, SID, Email, Sections, Total
Score, Max Points, Status, Submission ID, and one column for each question. Gradescope cannot import this
table: it imports grades only from results.json (see gradescope.py).
"""

from __future__ import annotations

import re
from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.intake.naming import GRADESCOPE
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import Book, name_of, points, report_of
from course_pkg.grading.roster.people import Person

HEAD = ["Name", "SID", "Email", "Sections", "Total Score", "Max Points", "Status", "Submission ID"]


def write(book: Book, out: Path) -> None:
    """Write a row for each student; students without a submission have the status Missing."""
    suffix = "" if book.sandboxed else ", run without a sandbox"
    parts = [
        clean.cell(f"{column.check}: {clean.line(column.goal)} ({points(column.possible)} pts){suffix}", 400)
        for column in book.columns
    ]
    rows = [[*HEAD, *parts]]
    rows += [_row(book, student) for student in book.students if student]
    blank = [""] * (1 + len(parts))
    rows += [
        [*_identity(person), "", points(book.total), "Missing", *blank] for person in book.class_list.missing
    ]
    put_table(out / "gradescope.csv", rows)


def _row(book: Book, student: str) -> list[str]:
    person = book.person(student) or Person(name=name_of(student))
    score = [points(book.earned(student)), points(book.possible_for(student)), "Graded"]
    reports = [report_of(book.grade(student, column.chapter), column.check) for column in book.columns]
    cells = ["" if report is None else points(report.points) for report in reports]
    return [*_identity(person), *score, submission_id(book, student), *cells]


def submission_id(book: Book, student: str) -> str:
    """Return the number of a student's submission on Gradescope, or "" for other platforms."""
    for grade in book.of(student):
        for part in grade.origin.split("/"):
            if GRADESCOPE.fullmatch(part):
                return re.sub(r"\D", "", part)
    return ""


def _identity(person: Person) -> list[str]:
    name = person.name or person.label
    return [clean.cell(text) for text in (name, person.id, person.email, person.section)]
