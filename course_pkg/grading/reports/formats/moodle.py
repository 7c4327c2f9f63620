"""moodle.csv, for Grades, Import, CSV file: Moodle asks which column is which.

Map `username` or `email` (or, for whoever was named by a download of Moodle's, `full name`), each chapter to
its grade item, and its feedback to "Feedback for": Moodle drops the grades of an item whose feedback comes
alone.
"""

from __future__ import annotations

from html import escape
from pathlib import Path

from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.naming import MOODLE, number_of
from course_pkg.grading.reports.book import Book, about_lateness, name_of, points
from course_pkg.grading.reports.files import put_table

LONG = 3_000  # characters of feedback


def write(book: Book, out: Path) -> None:
    """Write moodle.csv."""
    names = [f"Chapter {clean.line(chapter)}" for chapter in book.chapters]
    head = ["username", "email", "full name", "identifier"]
    rows = [[*head, *(text for name in names for text in (name, f"{name} feedback"))]]
    rows += [[*_identity(book, student), *_grades(book, student)] for student in book.students if student]
    put_table(out / "moodle.csv", rows)


def _identity(book: Book, student: str) -> list[str]:
    known, number = number_of(student, (grade.origin for grade in book.of(student)), MOODLE)
    if number:
        return ["", "", clean.cell(known), f"Participant {number}"]
    name = clean.cell(name_of(student))
    return ["", name, "", ""] if "@" in name.strip("'@") else [name, "", "", ""]


def _grades(book: Book, student: str) -> list[str]:
    grades = [book.grade(student, chapter) for chapter in book.chapters]
    return [text for grade in grades for text in (_cells(grade.for_student()) if grade else ("", ""))]


def _cells(grade: Grade) -> tuple[str, str]:
    """Return points and feedback; Moodle reads feedback as HTML."""
    sentences = [grade.problem, about_lateness(grade), *grade.notes, *map(_sentence, grade.reports)]
    words = " ".join(clean.line(text, 600) for text in sentences if text)
    return points(grade.earned), clean.cell(escape(clean.line(words, LONG), quote=False), 2 * LONG)


def _sentence(report: Report) -> str:
    if report.verdict is Verdict.PASSED:
        return f"{report.headline()}."
    hints = [rule.hint or rule.text for rule in report.rules if not rule.holds]
    return f"{report.headline()}. {' '.join([*hints, report.note])}"
