"""Applies an instructor's points and comments to grades."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace

from course_pkg.checking.report import Report, Review
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.gradebook import name_of
from course_pkg.grading.review.overrides import FILE, Override, Overrides

SHOWN = 10  # A line lists at most this many names.


def answer_of(grade: Grade, part: str) -> str:
    """Return a short text that identifies an answer: a digest of the student's code.

    The returned text begins with a letter; a spreadsheet therefore does not read it as a number.
    """
    code = clean.code(grade.code.get(part, ""))
    return f"v{hashlib.sha256(code.encode()).hexdigest()[:10]}"


def reviewed(grades: Sequence[Grade], overrides: Overrides) -> list[Grade]:
    """Return the grades with the points and comments of the instructor.

    The argument `grades` must contain only the points of the checks.
    """
    return [
        replace(grade, reports=tuple(_reviewed(grade, report, overrides) for report in grade.reports))
        for grade in grades
    ]


def is_outdated(row: Override, grade: Grade) -> bool:
    """Return whether the answer has changed since the instructor reviewed it."""
    return bool(row.answer) and row.answer != answer_of(grade, row.part)


def about_reviews(grades: Sequence[Grade]) -> list[str]:
    """Return the lines that a run prints about reviewed answers."""
    found = [(grade, report) for grade in grades for report in grade.reports if report.review]
    if not found:
        return []
    parts = "1 part has" if len(found) == 1 else f"{len(found)} parts have"
    lines = [f"{parts} points or a comment from {FILE}."]
    changed = [
        f"{name_of(grade.student)} {report.check}"
        for grade, report in found
        if report.review and report.review.outdated
    ]
    if changed:
        more = f" and {len(changed) - SHOWN} more" if len(changed) > SHOWN else ""
        lines.append(
            f"The answer has changed since its review: {', '.join(changed[:SHOWN])}{more}. The "
            "points from the review still count. `course review GRADES --unfinished` shows these answers."
        )
    return lines


def _reviewed(grade: Grade, report: Report, overrides: Overrides) -> Report:
    row = overrides.rows.get((grade.student, report.check))
    if row is None or (row.points is None and not row.comment):
        return report
    review = Review(row.comment, None if row.points is None else report.points, is_outdated(row, grade))
    return replace(report, points=report.points if row.points is None else row.points, review=review)
