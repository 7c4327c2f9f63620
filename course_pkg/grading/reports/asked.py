"""The assigned chapters, which count in a student's total even without a submission."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from course_pkg.checking.parts import chapters, parts_of
from course_pkg.grading.grade import Grade
from course_pkg.grading.points import PointsTable


def _always(_student: str, _chapter: str) -> bool:
    return True


@dataclass(frozen=True)
class Column:
    """A part that was graded or assigned."""

    check: str
    chapter: str
    goal: str
    possible: float


@dataclass(frozen=True)
class Asked:
    """The chapters and the selected parts of a run; `due` returns whether a chapter's deadline has passed.

    Reports also contain the chapters of earlier runs. Before its deadline, a chapter counts only for students
    who have submitted it.
    """

    chapters: frozenset[str] = frozenset()
    columns: tuple[Column, ...] = ()
    # The arguments of `due` are a student (or "" for an unknown student) and a chapter.
    due: Callable[[str, str], bool] = _always

    def counted(self, student: str, grades: Sequence[Grade], asked: Sequence[str]) -> list[str]:
        """Return the chapters in `asked` that count for a student who has the grades `grades`.

        A student who has only results from earlier runs has probably left the course. For this student, only
        the chapters with a grade count.
        """
        there = {grade.chapter for grade in grades}
        if there and all(grade.absent for grade in grades):
            return [chapter for chapter in asked if chapter in there]
        return [chapter for chapter in asked if chapter in there or self.due(student, chapter)]


def columns_of(selected: Sequence[str], table: PointsTable) -> tuple[Column, ...]:
    """Return the parts of the chapters `selected`, with their maximum points."""
    return tuple(
        Column(part.check, chapter, part.goal, table.parts[part.check].possible)
        for chapter in selected
        if chapter in chapters()
        for part in parts_of(chapter)
    )
