"""Grades selected notebooks or parts again; all other parts keep their results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.run.earlier import Earlier
from course_pkg.grading.run.selection import Selection, merged
from course_pkg.grading.store import Store


@dataclass(frozen=True)
class Regrade:
    """The selection of a run, and the earlier results that it completes."""

    selected: Selection
    earlier: Earlier
    fresh: bool = False  # --fresh: the selected notebooks are graded again, even if nothing has changed

    @property
    def again(self) -> bool:
        """Whether the selected notebooks are graded without the use of stored grades."""
        return self.fresh or self.selected.again

    def parts(self, submission: Submission) -> tuple[str, ...]:
        """Return the parts of a notebook that are graded again, or nothing for the whole notebook.

        The whole notebook is graded if the student has handed in another one since the last run, or if it
        has no earlier result.
        """
        asked = self.selected.parts_of(submission.chapter)
        return asked if asked and not submission.problem and self._base(submission) else ()

    def completed(self, grade: Grade, parts: tuple[str, ...]) -> Grade:
        """Return the grade with the earlier reports of all other parts, if only `parts` were graded."""
        base = self.earlier.find(grade.student, grade.chapter)
        return merged(base, grade) if parts and base else grade

    def keep(self, store: Store, graded: Grade, parts: tuple[str, ...], alike: Sequence[Submission]) -> None:
        """Store a new grade, which does not contain a student yet, for later runs.

        `alike` are the submissions with this grade. If only `parts` were graded, they replace those of the
        kept grade. A grade that was kept with other options, or by another version of the checks, is removed,
        so that the next complete run does not bring back the old points.
        """
        if not parts:
            store.keep(graded)
            return
        for submission in alike:
            base = self._base(submission)
            if base and base.key != graded.key:
                store.drop(base.key)
        if known := store.load(graded.key):
            store.keep(merged(known, graded))

    def _base(self, submission: Submission) -> Grade | None:
        found = self.earlier.find(submission.student, submission.chapter)
        return found if found and found.handed_in == submission.digest else None
