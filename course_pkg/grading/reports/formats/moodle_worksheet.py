"""moodle_worksheet.csv, a copy of Moodle's own grading worksheet with grades and feedback comments.

Only the columns Grade and Feedback comments change. They change only in rows of students with a submission
and an unlocked grade. If Moodle's maximum grade differs from the possible points, the points are scaled.
Without this scaling, Moodle would read 9 of 9 points as 9 of 100 points. Then the feedback also contains the
unscaled points. A worksheet belongs to one assignment, so the grade is the sum of all chapters of the run.
"""

from __future__ import annotations

from pathlib import Path

from course_pkg.files import write_atomically
from course_pkg.grading.reports.formats.moodle import feedback
from course_pkg.grading.reports.gradebook import Book, of_points, points

NAME = "moodle_worksheet.csv"


def write(book: Book, out: Path) -> None:
    """Write moodle_worksheet.csv if the instructor gave a worksheet."""
    class_list = book.class_list
    if class_list.worksheet is None:
        return
    graded = {
        participant.place: (_grade(book, student, participant.maximum), _feedback(book, student))
        for student, participant in class_list.participants.items()
        if book.total and not participant.locked and book.of(student)
    }
    write_atomically(out / NAME, class_list.worksheet.copy(graded))


def _grade(book: Book, student: str, maximum: float | None) -> str:
    """Return the points for Moodle, scaled to `maximum` if `maximum` is not None."""
    earned = book.earned(student)
    possible = book.possible_for(student)
    return points(earned if maximum is None or not possible else min(maximum, earned * maximum / possible))


def _feedback(book: Book, student: str) -> str:
    grades = [grade.for_student() for grade in book.of(student)]
    several = len(grades) > 1
    parts = [f"{of_points(book.earned(student), book.possible_for(student))}."]
    for grade in grades:
        title = f"Chapter {grade.chapter}: " if several and grade.chapter else ""
        parts.append(f"{title}{feedback(grade)}")
    return "<br>".join(parts)
