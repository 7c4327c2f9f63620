"""Makes small classes of students for the tests of flags."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.grading.flags.finding import with_flags
from course_pkg.grading.grade import Flag, Grade, Submission
from tests.grading.handing_in import raw, reference


@cache
def solutions(chapter: str) -> Mapping[str, str]:
    """Return the solutions of a chapter; the keys are the ids of the parts."""
    return {part: cell["source"] for cell in code_cells(reference(chapter)) if (part := exercise_of(cell))}


def submission(student: str, answers: Mapping[str, str], chapter: str = "05", origin: str = "") -> Submission:
    """Return a submission with these answers, and with blank cells for all other exercises."""
    notebook = reference(chapter)
    for cell in code_cells(notebook):
        if part := exercise_of(cell):
            cell["source"] = answers.get(part, handed_out(part, cell["source"]))
    return Submission(student, chapter, raw(notebook), origin or f"{student}/{chapter}.ipynb")


def flags_of(kinds: Sequence[str], *submissions: Submission) -> dict[str, tuple[Flag, ...]]:
    """For each student with flags, return the flags of the given kinds."""
    grades = [Grade(each.student, each.chapter, (), origin=each.origin) for each in submissions]
    flagged = with_flags(grades, submissions, kinds)
    return {grade.student: grade.flags for grade in flagged if grade.flags}
