"""gradescope/<student>/results.json, as an autograder of Gradescope leaves it.

Format: https://gradescope-autograders.readthedocs.io/en/latest/specs/
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.book import Book, about_lateness
from course_pkg.grading.reports.files import put


def write(book: Book, out: Path) -> None:
    """Write one file a student, all chapters in it."""
    for student in book.students:
        grades = [grade.for_student() for grade in book.of(student)]
        path = out / "gradescope" / clean.file_name(student or "nobody") / "results.json"
        put(path, json.dumps(_results(grades), indent=1, ensure_ascii=False) + "\n")


def _results(grades: list[Grade]) -> dict[str, Any]:
    words = [
        text for grade in grades for text in (grade.problem, about_lateness(grade), *grade.notes) if text
    ]
    return {
        "score": round(sum(grade.earned for grade in grades), 2),  # outranks the sum: lateness is taken off
        "output": "\n".join(clean.line(text) for text in words),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(report) for grade in grades for report in grade.reports],
    }


def _test(report: Report) -> dict[str, Any]:
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
