"""canvas.csv, which the gradebook of Canvas imports.

Canvas finds a student by the ID, or by one of the SIS columns. If Canvas does not know the name of a column,
it offers to create an assignment for this column. The second row contains the highest possible points.
"""

from __future__ import annotations

from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.intake.naming import CANVAS, number_of
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import Book, name_of, points

HEAD = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]


def write(book: Book, out: Path) -> None:
    """Write canvas.csv; a cell for a missing submission is empty, so Canvas keeps its own grade."""
    suffix = "" if book.sandboxed else ", run without a sandbox"
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
