"""gradescope/<student>/results.json, in the format of an autograder of Gradescope.

Format: https://gradescope-autograders.readthedocs.io/en/latest/specs/. Gradescope stores `extra_data`, but
does not show it. Here, `extra_data` contains the identity of the student. The names of its fields are from
https://gradescope-autograders.readthedocs.io/en/latest/submission_metadata/.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from course_pkg.checking.report import Report, Verdict
from course_pkg.files import write_atomically
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.formats.gradescope_table import submission_id
from course_pkg.grading.reports.gradebook import Book, about_lateness
from course_pkg.grading.roster.people import Person
from course_pkg.types.fields import Plain


def write(book: Book, out: Path) -> None:
    """Write one file for each student, with all chapters."""
    for student in book.students:
        grades = [grade.for_student() for grade in book.of(student)]
        path = out / "gradescope" / clean.file_name(student or "nobody") / "results.json"
        results = {**results_of(grades), "extra_data": _identity(book, student)}
        write_atomically(path, json.dumps(results, indent=1, ensure_ascii=False) + "\n")


def _identity(book: Book, student: str) -> dict[str, Plain]:
    person = book.person(student) or Person()
    known = {
        "student": clean.line(student, 120),
        "name": person.name,
        "sid": person.id,
        "email": person.email,
        "section": person.section,
        "submission_id": submission_id(book, student),
    }
    return {key: value for key, value in known.items() if value}


def results_of(grades: Sequence[Grade]) -> dict[str, Plain]:
    """Return the results of one student; `grades` contains only data that the student may see."""
    words = [
        text for grade in grades for text in (grade.problem, about_lateness(grade), *grade.notes) if text
    ]
    return {
        # Gradescope uses `score`, not the sum of the tests. `score` includes the deduction for lateness.
        "score": round(sum(grade.earned for grade in grades), 2),
        "output": "\n".join(clean.line(text) for text in words),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(report) for grade in grades for report in grade.reports],
    }


def _test(report: Report) -> dict[str, Plain]:
    return {
        "number": clean.line(report.check, 20),
        "name": clean.line(report.goal or report.check, 200),
        "name_format": "text",
        "score": report.points,
        "max_score": report.possible,
        "status": "passed" if report.verdict is Verdict.PASSED else "failed",
        "output": clean.text(report),
        "output_format": "text",
        "visibility": "visible",
    }
