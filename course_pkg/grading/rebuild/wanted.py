"""Finds the names and files that an exercise asks for, and the names that a student's cell defines.

A student's code is searched line by line. The code is not parsed, because some code makes a parser very slow
or crashes it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.grading.rebuild.defusing import WRITES, magic_of

SCANNED = 200_000  # At most this many characters of a cell are searched.
DEFINED = re.compile(r"^(?:async[ \t]+)?(?:def|class)[ \t]+(\w+)", re.MULTILINE)
ASSIGNED = re.compile(r"^(\w+)[ \t]*(?::[^=\n]{1,200})?=(?!=)", re.MULTILINE)
IMPORTED = re.compile(r"^(?:import|from[ \t]+[\w.]+[ \t]+import)[ \t]+([^\n#]{1,1000})", re.MULTILINE)
WORD = re.compile(r"[^\W\d]\w*")


@dataclass(frozen=True)
class Wanted:
    """One exercise in the solution notebook."""

    part: str
    cell: str  # `cell` is the id of the exercise cell.
    blank: str  # `blank` is the unchanged exercise cell that students get.
    first_line: str  # `first_line` is the cell magic in the first line, such as `%%writefile src/Area.srv`.
    names: frozenset[str]  # A student's answer has to define these names at the top level.
    # `wiring` contains the lines of the exercise cell that define no name, such as rospy.Service(…).
    wiring: frozenset[str]

    @property
    def path(self) -> str:
        """The file that the cell writes, or "" if the cell writes no file."""
        return written_path(self.first_line)

    def is_blank(self, source: str) -> bool:
        """Return whether `source` is the unchanged exercise cell; spaces at the ends of lines are ignored."""
        return _plain(source) == _plain(self.blank)


def every_wanted(reference: Notebook) -> list[Wanted]:
    """Return the exercises of a solution notebook, in their order."""
    return [
        _wanted(part, cell["id"], cell["source"])
        for cell in code_cells(reference)
        if (part := exercise_of(cell))
    ]


def _wanted(part: str, cell: str, solution: str) -> Wanted:
    blank = handed_out(part, solution)
    first_line = blank.partition("\n")[0] if blank.startswith("%%") else ""
    if written_path(first_line):
        wiring = frozenset(line.strip() for line in blank.split("\n")[1:] if len(line.strip()) > 4)
        return Wanted(part, cell, blank, first_line, frozenset(), wiring)
    callables = frozenset(DEFINED.findall(blank))
    names = callables or frozenset(ASSIGNED.findall(blank))
    lines = [line for line in blank.split("\n") if line and not line[0].isspace()]
    wiring = frozenset(
        line for line in lines if not (DEFINED.match(line) or line.startswith(("@", "#", ")", "%")))
    )
    return Wanted(
        part, cell, blank, first_line, names, frozenset(line for line in wiring if "..." not in line)
    )


def defined(source: str) -> set[str]:
    """Return the names that a cell's code defines, assigns or imports at the top level."""
    text = source[:SCANNED]
    return {*DEFINED.findall(text), *ASSIGNED.findall(text), *_imported(text)}


def lent(source: str) -> set[str]:
    """Return the names in a cell that other cells probably use: functions, classes, imports and constants."""
    text = source[:SCANNED]
    constants = {name for name in ASSIGNED.findall(text) if name.isupper()}
    return {*DEFINED.findall(text), *constants, *_imported(text)}


def used(source: str) -> set[str]:
    """Return all identifiers and other words in a cell's code."""
    return set(WORD.findall(source[:SCANNED]))


def written_path(source: str) -> str:
    """Return the path of the file that a cell writes with %%writefile, or ""."""
    found = WRITES.fullmatch(magic_of(source[:SCANNED]))
    return found["path"].strip("'\"") if found else ""


def _imported(text: str) -> set[str]:
    clauses = (clause for clauses in IMPORTED.findall(text) for clause in clauses.strip("() \t").split(","))
    return {words[-1].partition(".")[0] for clause in clauses if (words := clause.split())}


def _plain(source: str) -> list[str]:
    return [line.rstrip() for line in source.strip().splitlines()]
