"""Runs a graded notebook with nbval, and finds the cells with other outputs than the solution."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

from course_pkg.authoring.cells import Notebook, code_cells
from course_pkg.grading.grade import CellOutcome, Grade, Submission
from course_pkg.grading.nbval.findings import finding
from course_pkg.grading.plan import Plan
from course_pkg.sandbox.linux.bubblewrap import sandbox_command

# CELL is the time limit of a cell in s, on an idle machine. This limit makes nbval wait less than 60 s for a
# blocked kernel.
CELL = 40
LIMIT = 600.0  # LIMIT is the time limit of a notebook in s; the longest chapter takes 100 s.
LINE = 100  # LINE is the maximum number of characters of the first line of a cell.
OUTPUT = 8 << 20  # OUTPUT is the maximum number of bytes of nbval's output.


def wanted(grade: Grade, whose: str) -> bool:
    """Return whether nbval runs a notebook.

    `whose` is "all", "none" or "missing"; "missing" means the notebooks that do not have all points.
    """
    if not grade.reports or grade.problem or whose == "none":
        return False
    return whose == "all" or any(report.points < report.possible for report in grade.reports)


def validated(grade: Grade, submission: Submission, plan: Plan) -> Grade:
    """Return the grade, and add the result of nbval for each cell of the notebook.

    If there are no results, a note in the grade says why.
    """
    if not grade.sandboxed:
        return replace(
            grade,
            notes=(*grade.notes, ("nbval runs notebooks only in a sandbox, but this run had no sandbox.")),
        )
    cells = outcomes_of(plan.rebuilder.rebuild(submission.content).notebook)
    if not cells:
        return replace(grade, notes=(*grade.notes, f"nbval did not finish within {LIMIT:g} s."))
    return replace(grade, cells=cells)


def outcomes_of(notebook: Notebook, *, timeout: float = LIMIT, cell: int = CELL) -> tuple[CellOutcome, ...]:
    """Run nbval on the notebook in a sandbox; `cell` is the time limit of each cell in s.

    Returns an empty tuple if the notebook takes more than `timeout` s.
    """
    command = sandbox_command([sys.executable, "-m", "course_pkg.grading.nbval.process", str(cell)])
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
    first = {each["id"]: _first_line(each["source"]) for each in code_cells(notebook)}
    records = [json.loads(line) for line in lines if line.startswith("{")]
    return tuple(
        CellOutcome(each["cell"], each["outcome"], finding(each["words"]), first.get(each["cell"], ""))
        for each in records
    )


def _first_line(source: str) -> str:
    return next((line for line in source.splitlines() if line.strip()), "")[:LINE]
