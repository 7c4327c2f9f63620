"""The state of a review: the answers, the rows of overrides.csv, and the changes that can be undone."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.gradebook import name_of
from course_pkg.grading.review.applying import is_outdated
from course_pkg.grading.review.items import Item, Wanted, identical, items_of
from course_pkg.grading.review.overrides import (
    LONG,
    Key,
    Override,
    Overrides,
    points_of,
    read_overrides,
    save,
)
from course_pkg.types.fields import Plain

QUIET = 0.3  # For this time in s after another program has changed the file, the file can be incomplete.
Rows = Mapping[Key, Override | None]


@dataclass(frozen=True)
class Step:
    """One change that can be undone: the rows before and after the change."""

    before: Rows
    after: Rows


class Session:
    """The review of one folder of results.

    Each method that changes a row first reads overrides.csv again. Therefore, changes by another program are
    not lost. The methods raise GradingError if a row of the file is wrong, and OSError if the file cannot be
    written.
    """

    def __init__(self, out: Path, grades: Sequence[Grade], wanted: Wanted) -> None:
        self._grades = grades
        self._all = items_of(grades)
        self._out = out
        self._overrides = self._read()
        self._steps: list[Step] = []
        self.items = [item for item in self._all if wanted.includes(item, self._overrides)]
        self._numbers = {item.key: number for number, item in enumerate(self.items)}

    def describe(self) -> dict[str, Plain]:
        """Return the data for the page: all answers, and all rows of overrides.csv."""
        items = [
            {
                "name": name_of(item.grade.student),
                "part": item.report.check,
                "verdict": item.report.verdict.value,
                "points": item.report.points,
                "possible": item.report.possible,
                "flagged": bool(item.flags),
            }
            for item in self.items
        ]
        return {"items": items, "rows": self.rows(), "undo": len(self._steps)}

    def rows(self) -> dict[str, Plain]:
        """Return the rows about the answers of this review; the keys are the numbers of the answers."""
        return self._shown(self._overrides.rows)

    def alike(self, number: int) -> list[Item]:
        """Return the answers of other students that are identical to the answer `number`."""
        return identical(self.items[number], self._all)

    def is_being_written(self) -> bool:
        """Return whether another program has just changed overrides.csv; such a file can be incomplete."""
        try:
            written = self._overrides.path.stat().st_mtime
        except OSError:
            return False
        return -QUIET < time.time() - written < QUIET and self._is_changed()

    def refresh(self) -> bool:
        """Read overrides.csv again; return whether another program has changed this file."""
        before, self._overrides = self._overrides, self._read()
        if before.rows and not self._overrides.digest:
            self._overrides = before
            raise GradingError(
                f"The file {before.path} had {len(before.rows)} rows, but now it is empty or does not exist. "
                "Restore the file, or end this review and start it again without the file."
            )
        return before.digest != self._overrides.digest

    def decide(self, number: int, points: str, comment: str, *, also_identical: bool) -> dict[str, Plain]:
        """Store the points and the comment for an answer, and return the changed rows.

        If the points and the comment are empty, the row is removed.

        Raises ValueError if the points are not a number, or are higher than the maximum.
        """
        item = self.items[number]
        value, words = points_of(points), clean.text(comment, LONG).strip()
        if value is not None and value > item.report.possible:
            raise ValueError(f"{value:g} points are more than the maximum of {item.report.possible:g} points")
        items = [item, *(self.alike(number) if also_identical else ())]
        changes: dict[Key, Override | None] = {
            each.key: Override(each.grade.student, each.report.check, value, words, each.answer)
            if value is not None or words
            else None
            for each in items
        }
        return self._change(changes, undoing=False)

    def undo(self) -> dict[str, Plain]:
        """Undo the last change, and return the restored rows.

        In the result, `shown` is the number of the answer that belongs to the first restored row.

        Raises ValueError if there is nothing to undo, or if another program has changed one of the rows.
        """
        if not self._steps:
            raise ValueError("there is no change to undo")
        reloaded, step = self.refresh(), self._steps[-1]
        if any(self._overrides.rows.get(key) != row for key, row in step.after.items()):
            self._steps.pop()
            raise ValueError(
                "another program has changed this row after your change, so your change was not undone"
            )
        done = self._change(step.before, undoing=True)
        self._steps.pop()
        shown = self._numbers.get(next(iter(step.before)))
        return {**done, "reloaded": reloaded or done["reloaded"], "shown": shown, "undo": len(self._steps)}

    def _change(self, changes: Rows, *, undoing: bool) -> dict[str, Plain]:
        reloaded = self.refresh()
        before = {key: self._overrides.rows.get(key) for key in changes}
        self._overrides = save(self._overrides, changes)
        if not undoing and before != changes:
            self._steps.append(Step(before, changes))
        rows = self.rows() if reloaded else self._shown(changes)
        return {"rows": rows, "reloaded": reloaded, "count": len(changes), "undo": len(self._steps)}

    def _read(self) -> Overrides:
        found = read_overrides(self._out)
        found.require_parts(self._grades)
        return found

    def _is_changed(self) -> bool:
        try:
            return read_overrides(self._out).digest != self._overrides.digest
        except GradingError:
            return True  # A wrong row is not reported, because the file can be incomplete.

    def _shown(self, rows: Rows) -> dict[str, Plain]:
        numbered = ((self._numbers.get(key), row) for key, row in rows.items())
        return {str(number): self._row(number, row) for number, row in numbered if number is not None}

    def _row(self, number: int, row: Override | None) -> Plain:
        if row is None:
            return None
        outdated = is_outdated(row, self.items[number].grade)
        return {"points": row.points, "comment": row.comment, "outdated": outdated}
