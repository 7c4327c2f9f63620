"""The results of earlier runs; a result remains in the reports until a run replaces it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from course_pkg.grading.grade import Grade, grade_from
from course_pkg.grading.reports.records import RESULTS, record_path
from course_pkg.grading.run.selection import Selection


@dataclass(frozen=True)
class Earlier:
    """The records of earlier runs in the folder `out`.

    `unreadable` is the number of files in this folder that this version of the course cannot read.
    """

    out: Path
    grades: tuple[Grade, ...] = ()
    unreadable: int = 0

    def find(self, student: str, chapter: str) -> Grade | None:
        """Return a student's earlier grade for a chapter, or None if there is no earlier grade.

        The grade contains the points of the checks, not an instructor's points.
        """
        found = self._by_chapter.get((student, chapter)) if chapter else None
        return found.unreviewed() if found else None

    def rest(self, graded: Sequence[Grade], selected: Selection) -> list[Grade]:
        """Return the earlier grades that the reports contain in addition to the new grades `graded`.

        The returned grades contain the points of the checks, not an instructor's points.

        An earlier grade is marked as absent if this run selects the student and the chapter, but the student
        has no submission. However, a run without a selection can have no submission at all for a chapter.
        Then the chapter's grades are not marked: the chapter probably belongs to another assignment.
        """
        chapters = {grade.chapter for grade in graded}
        now = {(grade.student, grade.chapter) for grade in graded if grade.chapter}
        files = {(grade.student, grade.origin) for grade in graded if not grade.chapter}
        kept = []
        for grade in (each.unreviewed() for each in self.grades):
            covered = selected.covers(grade.student, grade.chapter)
            if (grade.student, grade.chapter) in now or (grade.student, grade.origin) in files:
                continue
            if grade.chapter or not covered:
                marked = covered and (grade.chapter in chapters or not selected.everything)
                kept.append(replace(grade, absent=True) if marked else grade)
        return kept

    def forget_files(self, graded: Sequence[Grade], selected: Selection) -> None:
        """Remove the records of files that could not be graded in an earlier run.

        A record is removed only if the student's file no longer exists.
        """
        now = {(grade.student, grade.origin) for grade in graded if not grade.chapter}
        for grade in self.grades:
            gone = (grade.student, grade.origin) not in now
            if not grade.chapter and gone and selected.covers(grade.student, ""):
                record_path(self.out, grade.student, "", grade.origin).unlink(missing_ok=True)

    @cached_property
    def _by_chapter(self) -> dict[tuple[str, str], Grade]:
        return {(grade.student, grade.chapter): grade for grade in self.grades}


def read_earlier(out: Path) -> Earlier:
    """Return the records in the folder `out`, and the number of files that this version cannot read."""
    grades, unreadable = [], 0
    for path in sorted((out / RESULTS).glob("*/*.json")):
        if path.name.startswith("."):
            continue
        try:
            grades.append(grade_from(json.loads(path.read_text("utf-8"))))
        except (OSError, ValueError, TypeError, KeyError, AttributeError):
            unreadable += 1
    return Earlier(out, tuple(grades), unreadable)
