"""The solutions that a submission can be one of, and which of them it is."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from course_pkg.authoring.cells import exercise_of
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.grading.reading import StudentCell

ENOUGH = 5  # ids that a notebook has to share with a solution, where none is an exercise's


class References:
    """All solutions of a checkout, by what tells one from another."""

    def __init__(self, root: Path | None = None) -> None:
        self._stems: dict[str, str] = {}
        self._parts: dict[str, str] = {}
        self._ids: dict[str, list[str]] = {}
        for path in Shelf(root).solutions():
            chapter = path.name[:2]
            self._stems[chapter] = _plain(path.stem)
            for cell in read(path)["cells"]:
                self._ids.setdefault(cell["id"], []).append(chapter)
                if part := exercise_of(cell):
                    self._parts[part] = self._parts[cell["id"]] = chapter

    @property
    def chapters(self) -> list[str]:
        """The chapters, such as ["00", "05"]."""
        return sorted(self._stems)

    def by_name(self, stem: str) -> str:
        """Return the chapter that the file's name says, known or not; an empty text when it says none."""
        name = _plain(stem)
        for chapter, known in self._stems.items():
            if known in name:
                return chapter
        for chapter, known in self._stems.items():
            if known[3:] in name:
                return chapter
        found = re.match(r"(?:copy_of_)?(?:chapter_?)?(\d{1,2})(?:_|$)", name)
        return found[1].zfill(2) if found else ""

    def by_cells(self, cells: Sequence[StudentCell], favoured: str) -> str:
        """Return the chapter that most of the exercises are of, `favoured` if as many; else by all ids."""
        asked = Counter(
            self._parts[key] for cell in cells for key in {cell.id, cell.exercise} if key in self._parts
        )
        if asked:
            return max(asked, key=lambda chapter: (asked[chapter], chapter == favoured, chapter))
        shared = Counter(chapter for cell in cells for chapter in self._ids.get(cell.id, []))
        chapter, count = max(shared.items(), key=lambda item: (item[1], item[0]), default=("", 0))
        return chapter if count >= ENOUGH else ""


def _plain(stem: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", stem.lower()).strip("_")
