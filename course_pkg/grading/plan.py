"""The parts of a chapter, and the cells that each part needs.

A plan is computed once, and used for all submissions.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import course_pkg
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.fixtures import around
from course_pkg.checking.parts import Part, exercise_of, parts_of
from course_pkg.grading.rebuild.rebuilder import Rebuilder
from course_pkg.setup import CATKIN_FOLDERS
from course_pkg.setup.stamps import digest


@dataclass(frozen=True)
class PartPlan:
    """One part: its check, and the code of the course that runs before and after the student's answer."""

    part: Part
    before: str
    after: str

    @property
    def exercise(self) -> str:
        """The id of the exercise that the part examines."""
        return exercise_of(self.part.check)

    @property
    def private(self) -> bool:
        """Whether the part is an instructor's private part."""
        return self.exercise != self.part.check


@dataclass(frozen=True)
class Plan:
    """The parts of a chapter; `rebuilder` puts a student's answers into the chapter's solution notebook."""

    chapter: str
    rebuilder: Rebuilder
    parts: tuple[PartPlan, ...]


def plan(chapter: str) -> Plan:
    """Return the plan for grading a chapter, such as "05"."""
    rebuilder = Rebuilder(read(NotebookStore().solutions([chapter])[0]))
    return Plan(chapter, rebuilder, tuple(map(_planned, parts_of(chapter))))


def _planned(part: Part) -> PartPlan:
    before, after = around(exercise_of(part.check))
    return PartPlan(part, before, after)


@cache
def course_digest() -> str:
    """Return a digest of all files that affect a grade: code, checks, types, solutions."""
    root = Path(course_pkg.__file__).parent
    folders = [root, *(root.parent / name for name in ("solutions", *CATKIN_FOLDERS))]
    paths = sorted(path for folder in folders for path in folder.rglob("*") if _counts(path))
    return digest(part for path in paths for part in (str(path.relative_to(root.parent)), path.read_bytes()))


def _counts(path: Path) -> bool:
    apart = {"site", "lab"} & set(path.parts)  # Grades do not depend on these folders.
    return (
        path.is_file() and not apart and path.suffix in {".py", ".srv", ".ipynb", ".launch", ".msg", ".json"}
    )
