"""Grades selected notebooks or parts again; the results of all other parts do not change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.run.earlier import Earlier
from course_pkg.grading.run.selection import Selection, merged
from course_pkg.grading.store import Store


@dataclass(frozen=True)
class Regrade:
    """The selection of a run, and the earlier results with which the new results are combined."""

    selected: Selection
    earlier: Earlier
    fresh: bool = False

    @property
    def again(self) -> bool:
        """Whether the run grades the selected notebooks again even if their grades are already stored."""
        return self.fresh or self.selected.again

    def parts(self, submission: Submission) -> tuple[str, ...]:
        """Return the parts of a notebook that are graded again, or () if the whole notebook is graded.

        The whole notebook is graded if there is no earlier result, or if the student has submitted another
        notebook since the last run.
        """
        asked = self.selected.parts_of(submission.chapter)
        return asked if asked and not submission.problem and self._base(submission) else ()

    def completed(self, grade: Grade, parts: tuple[str, ...]) -> Grade:
        """Return the grade; if only `parts` were graded, add the earlier reports on all other parts."""
        base = self.earlier.find(grade.student, grade.chapter)
        return merged(base, grade) if parts and base else grade

    def keep(self, store: Store, graded: Grade, parts: tuple[str, ...], alike: Sequence[Submission]) -> None:
        """Store a new grade for later runs; the grade does not contain a student's name yet.

        All submissions in the list `alike` get the grade `graded`. If only `parts` were graded, the new
        reports on these parts replace the reports in the stored grade. Remove a stored grade that was
        computed with other options or another version of the checks. Otherwise, a later run of the whole
        notebook could use the points of this grade.
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
