"""moodle.csv can be imported into Moodle with the menu Grades, Import, CSV file.

During the import, Moodle asks for the meaning of each column.

In Moodle's dialog, map the column `username` or `email` to the student. Moodle cannot find a student by a
full name or a participant number. For submissions from Moodle, `username` and `email` come from a roster or
from Moodle's worksheet. Map the column of each chapter to the grade item of this chapter, and the feedback
column to "Feedback for". Always map both the grade column and the feedback column of a chapter. If only the
feedback for an item is imported, Moodle deletes the grade of this item
(https://docs.moodle.org/en/Grade_import). If you need the grades of only one assignment, the copy of Moodle's
worksheet is simpler (moodle_worksheet.py).
"""

from __future__ import annotations

from html import escape
from pathlib import Path

from course_pkg.checking.report import Report, Verdict
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import Book, about_lateness, name_of, points

LONG = 3_000  # A feedback text has at most this many characters.


def write(book: Book, out: Path) -> None:
    """Write moodle.csv."""
    names = [f"Chapter {clean.line(chapter)}" for chapter in book.chapters]
    head = ["username", "email", "full name", "identifier"]
    rows = [[*head, *(text for name in names for text in (name, f"{name} feedback"))]]
    rows += [[*_identity(book, student), *_grades(book, student)] for student in book.identified]
    put_table(out / "moodle.csv", rows)


def _identity(book: Book, student: str) -> list[str]:
    person = book.person(student)
    if person is None:
        name = clean.cell(name_of(student))
        return ["", name, "", ""] if "@" in name.strip("'@") else [name, "", "", ""]
    number = f"Participant {person.number}" if person.number else ""
    return [*map(clean.cell, (person.username, person.email, person.name)), number]


def _grades(book: Book, student: str) -> list[str]:
    grades = [book.grade(student, chapter) for chapter in book.chapters]
    return [text for grade in grades for text in (_cells(grade.for_student()) if grade else ("", ""))]


def _cells(grade: Grade) -> tuple[str, str]:
    return points(grade.earned), clean.cell(feedback(grade), 2 * LONG)


def feedback(grade: Grade) -> str:
    """Return the feedback about a grade in one line; Moodle reads feedback as HTML."""
    sentences = [grade.problem, about_lateness(grade), *grade.notes, *map(_sentence, grade.reports)]
    words = " ".join(clean.line(text, 600) for text in sentences if text)
    return escape(clean.line(words, LONG), quote=False)


def _sentence(report: Report) -> str:
    review = report.about_review()
    if report.verdict is Verdict.PASSED:
        return " ".join([f"{report.headline()}.", *review])
    hints = [assertion.hint or assertion.text for assertion in report.assertions if not assertion.holds]
    return f"{report.headline()}. {' '.join([*hints, report.note, *review])}"
