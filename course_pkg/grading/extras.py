"""Reads an instructor's additional exercises and points from a private folder that students never see.

The file private_05.py declares additional parts for the exercises of chapter 05. For example, the check of
the part "05.1.1" runs after the student's cell of exercise 05.1. The file points.json sets other points for
the parts (see points.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from course_pkg.checking.parts import add_private, chapters, parts_of
from course_pkg.errors import GradingError
from course_pkg.grading.run.private_folder import POINTS, require_names, require_parts
from course_pkg.setup.stamps import digest


@dataclass(frozen=True)
class Extras:
    """The folder with an instructor's private exercises and points, if there is one."""

    folder: Path | None = None

    @property
    def digest(self) -> str:
        """Return a digest of the private parts; the digest does not depend on the points."""
        files = sorted(self.folder.glob("*.py")) if self.folder else []
        return digest([part for path in files for part in (path.name, path.read_bytes())])

    @property
    def points(self) -> Path | None:
        """The path of the private points.json, or None if there is no such file."""
        path = self.folder / POINTS if self.folder else None
        return path if path and path.exists() else None


def read_extras(folder: Path | None) -> Extras:
    """Add the private parts in this folder to the course; raise GradingError if a file is not valid."""
    if folder is None:
        return Extras()
    if not folder.is_dir():
        raise GradingError(
            f"{folder} is not a folder. Give the folder that contains private_NN.py and points.json."
        )
    folder = folder.resolve()
    require_names(folder, chapters())
    add_private(str(folder))
    try:
        for chapter in chapters():
            parts_of(chapter)
    except Exception as error:
        raise GradingError(
            f"The private parts in {folder} cannot be read: {type(error).__name__}: {error}"
        ) from error
    require_parts(folder)
    return Extras(folder)
