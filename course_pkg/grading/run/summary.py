"""The last lines and the exit status of a run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.gradebook import name_of, needs_look

GRADED, NEED_A_LOOK = 0, 3
SHOWN = 10  # SHOWN is the maximum number of names in a line.


def status_of(graded: Sequence[Grade]) -> int:
    """Return the exit status GRADED, or NEED_A_LOOK if an instructor has to examine a submission."""
    return NEED_A_LOOK if any(map(needs_look, graded)) else GRADED


def last_line(graded: Sequence[Grade]) -> str:
    """Return the last line that a run prints, for example "45 graded, 22 need a look"."""
    looks = sum(map(needs_look, graded))
    return f"{len(graded) - looks} graded, {looks} {'needs' if looks == 1 else 'need'} a look"


def about_empty(graded: Sequence[Grade]) -> list[str]:
    """Return a line about students with empty folders, or no line if there are none."""
    names = [name_of(grade.student) for grade in graded if grade.nothing]
    return (
        [f"These students handed in nothing, because their folders are empty: {_listed(names)}."]
        if names
        else []
    )


def about_flags(grades: Sequence[Grade]) -> list[str]:
    """Return a line about students with flags, or no line if there are none."""
    count = len({grade.student for grade in grades if grade.flags})
    students = "1 student has" if count == 1 else f"{count} students have"
    return (
        [f"{students} flags. Flags do not change points. Read the section Flags in class.html."]
        if count
        else []
    )


def about_rest(rest: Sequence[Grade], out: Path) -> list[str]:
    """Return lines about the results of earlier runs that stay in the reports."""
    absent = [grade for grade in rest if grade.absent]
    kept = len(rest) - len(absent)
    lines = []
    if absent:
        names = [f"{name_of(grade.student)} (chapter {grade.chapter})" for grade in absent]
        lines.append(
            "These results are from an earlier run, because nothing was handed in this time: "
            f"{_listed(names)}. class.html and grades.csv mark these results. The files for Moodle, "
            "Canvas and Gradescope do not contain them."
        )
    if kept:
        results = "1 other result" if kept == 1 else f"{kept} other results"
        lines.append(f"{results} in {out} did not change.")
    return lines


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{', '.join(names[:SHOWN])}{more}"
