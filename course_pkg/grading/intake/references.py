"""Finds the chapter of a submission by comparing the submission with the course's solutions."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from course_pkg.authoring.cells import exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.grading.intake.reading import StudentCell

# If a notebook has no exercise ids, its chapter is found by the ids of all cells. At least `ENOUGH` cell ids
# must also be in the chapter's solution.
ENOUGH = 5


class References:
    """All solutions of a checkout, and the ids of the cells in each solution."""

    def __init__(self, root: Path | None = None) -> None:
        self._stems: dict[str, str] = {}
        self._parts: dict[str, str] = {}
        self._ids: dict[str, list[str]] = {}
        for path in NotebookStore(root).solutions():
            chapter = path.name[:2]
            self._stems[chapter] = plain(path.stem)
            for cell in read(path)["cells"]:
                self._ids.setdefault(cell["id"], []).append(chapter)
                if part := exercise_of(cell):
                    self._parts[part] = self._parts[cell["id"]] = chapter

    @property
    def chapters(self) -> list[str]:
        """The chapters, such as ["00", "05"]."""
        return sorted(self._stems)

    def name_of(self, chapter: str) -> str:
        """Return the name of the chapter's notebook without the extension."""
        return self._stems.get(chapter, f"{chapter}_topic")

    def by_name(self, stem: str) -> str:
        """Return the chapter number in the file name, even if no chapter has this number.

        Return "" if the name contains no number.
        """
        name = plain(stem)
        for chapter, known in self._stems.items():
            if known in name:
                return chapter
        for chapter, known in self._stems.items():
            if known[3:] in name:
                return chapter
        found = re.match(r"(?:copy_of_)?(?:chapter_?)?(\d{1,2})(?:_|$)", name)
        return found[1].zfill(2) if found else ""

    def by_cells(self, cells: Sequence[StudentCell], favoured: str) -> str:
        """Return the chapter to which most of the notebook's exercises belong.

        If two chapters have the same number of exercises in the notebook, prefer the chapter `favoured`.

        If the notebook has no exercises, the ids of all cells are compared.
        """
        asked = Counter(
            self._parts[key] for cell in cells for key in {cell.id, cell.exercise} if key in self._parts
        )
        if asked:
            return max(asked, key=lambda chapter: (asked[chapter], chapter == favoured, chapter))
        return self.by_ids(cells)

    def by_ids(self, cells: Sequence[StudentCell]) -> str:
        """Return the chapter with the solution that has the most ids in common with the cells.

        If fewer than `ENOUGH` ids are equal, return "".
        """
        shared = Counter(chapter for cell in cells for chapter in self._ids.get(cell.id, []))
        chapter, count = max(shared.items(), key=lambda item: (item[1], item[0]), default=("", 0))
        return chapter if count >= ENOUGH else ""


def plain(stem: str) -> str:
    """Return a file's name in lower case, with single underscores between the words."""
    return re.sub(r"[^a-z0-9]+", "_", stem.lower()).strip("_")
