"""grades.csv, a table for a spreadsheet, with a row for each student and a column for each part."""

from __future__ import annotations

from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.flags import flag_words
from course_pkg.grading.reports.gradebook import (
    Book,
    about_lateness,
    attention,
    name_of,
    not_handed_in,
    notes,
    points,
    report_of,
    reviews,
)
from course_pkg.grading.reports.roster import MISSING, about_identity, identity_cells
from course_pkg.grading.roster.people import FIELDS


def write(book: Book, out: Path) -> None:
    """Write grades.csv; a byte order mark tells a spreadsheet that the file is UTF-8.

    With a roster, the file contains the students' identities, and a row for each student without a
    submission.
    """
    listed = book.class_list.given
    head = ["student", *(FIELDS if listed else ())]
    for chapter in book.chapters:
        head += [
            *(column.check for column in book.columns_of(chapter)),
            f"{chapter} days late",
            f"{chapter} total",
        ]
    rows = [[*map(clean.cell, head), "earned", "possible", "notes", "flags"]]
    rows += [_row(book, student) for student in book.students]
    blank = [""] * (len(rows[0]) - len(FIELDS) - 5)
    rows += [
        [clean.cell(person.label), *identity_cells(person), *blank, "0", points(book.total), MISSING, ""]
        for person in book.class_list.missing
    ]
    put_table(out / "grades.csv", rows, "utf-8-sig")


def _row(book: Book, student: str) -> list[str]:
    """Return a student's row in grades.csv.

    Cells for missing submissions are empty. Only the totals include the deduction for lateness.
    """
    identity = identity_cells(book.person(student)) if book.class_list.given else []
    cells = [clean.cell(name_of(student)), *identity]
    for chapter in book.chapters:
        grade = book.grade(student, chapter)
        reports = [report_of(grade, column.check) for column in book.columns_of(chapter)]
        cells += ["" if report is None else points(report.points) for report in reports]
        cells += [points(grade.late), points(grade.earned)] if grade else ["", ""]
    late = [about_lateness(grade) for grade in book.of(student)]
    found = [
        *late,
        *about_identity(book, student),
        *attention(book, student),
        not_handed_in(book, student),
        *notes(book, student),
        *reviews(book, student),
    ]
    words = " | ".join(filter(None, found))
    totals = [points(book.earned(student)), points(book.possible_for(student))]
    return [*cells, *totals, clean.cell(words, 3000), clean.cell(flag_words(book, student), 3000)]
