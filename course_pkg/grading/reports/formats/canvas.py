"""canvas.csv, which the gradebook of Canvas imports.

Canvas finds a student by the ID, else by one of the SIS columns; a column of points with a name that it does
not know it offers as a new assignment. The second row holds the points that are possible.
"""

from __future__ import annotations

from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.naming import CANVAS, number_of
from course_pkg.grading.reports.book import Book, name_of, points
from course_pkg.grading.reports.files import put_table

HEAD = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]


def write(book: Book, out: Path) -> None:
    """Write canvas.csv; what was not handed in is empty, which leaves Canvas's own grade alone."""
    suffix = "" if book.walls else ", run without walls"
    rows = [
        [*HEAD, *(f"Chapter {clean.line(chapter)}{suffix}" for chapter in book.chapters)],
        [
            "    Points Possible",
            "",
            "",
            "",
            "",
            *(points(book.possible(chapter)) for chapter in book.chapters),
        ],
    ]
    rows += [[*_identity(book, student), *_points(book, student)] for student in book.students if student]
    put_table(out / "canvas.csv", rows)


def _identity(book: Book, student: str) -> list[str]:
    name, number = number_of(student, (grade.origin for grade in book.of(student)), CANVAS)
    if number:
        return [clean.cell(name), number, "", "", ""]
    return [clean.cell(name_of(student)), "", "", clean.cell(name_of(student)), ""]


def _points(book: Book, student: str) -> list[str]:
    grades = [book.grade(student, chapter) for chapter in book.chapters]
    return ["" if grade is None else points(grade.earned) for grade in grades]
