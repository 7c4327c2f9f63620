"""nbval's run of a rebuilt notebook: which of its cells show what the reference shows; feedback alone."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

from course_pkg.authoring.cells import Notebook
from course_pkg.grading.grade import CellOutcome, Grade, Submission
from course_pkg.grading.plan import Plan
from course_pkg.grading.walls import enclosed

CELL = 60  # s; a kernel that has ended is noticed after that, by nbval
LIMIT = 600.0  # s for a notebook; the longest chapter takes 100
OUTPUT = 8 << 20  # bytes of what comes back


def wanted(grade: Grade, whose: str) -> bool:
    """Return whether a notebook is run: of `whose`, "all", "none", or of those with points "missing"."""
    if not grade.reports or grade.problem or whose == "none":
        return False
    return whose == "all" or any(report.points < report.possible for report in grade.reports)


def validated(grade: Grade, submission: Submission, plan: Plan) -> Grade:
    """Return `grade` with the outcomes of the rebuilt notebook's cells; a note where nbval came to no end."""
    if not grade.walls:
        return replace(
            grade, notes=(*grade.notes, "nbval runs notebooks behind walls only, and there are none.")
        )
    cells = outcomes_of(plan.rebuilder.rebuild(submission.content).notebook)
    if not cells:
        return replace(grade, notes=(*grade.notes, f"nbval came to no end within {LIMIT:g} s."))
    return replace(grade, cells=cells)


def outcomes_of(notebook: Notebook, *, timeout: float = LIMIT, cell: int = CELL) -> tuple[CellOutcome, ...]:
    """Run nbval on `notebook`, at most `cell` s a cell, the kernel behind walls of its own.

    Returns nothing if the whole takes more than `timeout` s.
    """
    command = enclosed([sys.executable, "-m", "course_pkg.grading.ward.validating", str(cell)])
    with subprocess.Popen(
        command, env={}, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as process:
        try:
            out, _ = process.communicate(json.dumps(notebook).encode(), timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return ()
    lines = out[:OUTPUT].decode("utf-8", "replace").splitlines()
    return tuple(CellOutcome(**json.loads(line)) for line in lines if line.startswith("{"))
