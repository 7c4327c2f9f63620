"""The folder that a site is written to: what an earlier site left in it goes, what is not a site's stays."""

from __future__ import annotations

import shutil
from pathlib import Path
from types import TracebackType

from course_pkg.errors import SiteError

LIST = ".course-site"  # in the folder: the files that the site consists of


class Folder:
    """A site being written: when the block ends well, files of an earlier site that are not in it go."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._list = path / LIST
        self._written: set[str] = set()

    def __enter__(self) -> Folder:
        """Take hold of the folder. Raises SiteError where it holds something else than a site."""
        try:
            self._path.mkdir(parents=True, exist_ok=True)
            foreign = not self._list.exists() and any(self._path.iterdir())
        except OSError as error:
            raise SiteError(
                f"{self._path} cannot be used: {error.strerror}. Name another with --out."
            ) from error
        if foreign:
            raise SiteError(
                f"{self._path} holds files that are no site. Name an empty or a new folder with --out."
            )
        self._list.touch()
        self._before = set(self._list.read_text("utf-8").split("\n"))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _error: object, _trace: TracebackType | None
    ) -> None:
        gone = set() if kind else self._before - self._written
        for name in filter(None, gone):
            (self._path / name).unlink(missing_ok=True)
        self._list.write_text("\n".join(sorted((self._before | self._written) - gone)), "utf-8")

    def write(self, name: str, text: str) -> None:
        """Write a file of the site."""
        self._place(name).write_text(text, "utf-8")

    def copy(self, source: Path, name: str) -> None:
        """Copy a file into the site."""
        shutil.copyfile(source, self._place(name))

    def _place(self, name: str) -> Path:
        self._written.add(name)
        place = self._path / name
        place.parent.mkdir(exist_ok=True)
        return place
