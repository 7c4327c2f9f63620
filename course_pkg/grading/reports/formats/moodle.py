"""moodle.csv, for Moodle's menu Grades, Import, CSV file; Moodle asks for the meaning of each column.

Map the column `username` or `email` to the student (or `full name`, if the names come from a download from
Moodle). Map each chapter to its grade item, and its feedback to "Feedback for". Always map both: Moodle
deletes the grade of an item if only its feedback is imported.
"""

from __future__ import annotations

from html import escape
from pathlib import Path

from course_pkg.checking.report import Report, Verdict
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.intake.naming import MOODLE, number_of
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import Book, about_lateness, name_of, points

LONG = 3_000  # maximum number of characters of feedback


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
    hints = [assertion.hint or assertion.text for assertion in report.assertions if not assertion.holds]
    return f"{report.headline()}. {' '.join([*hints, report.note])}"
