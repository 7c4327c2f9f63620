"""Runs notebooks for the site, and stores their outputs.

A notebook runs again only if its code, or a file that its code uses, has changed. The site cannot use the
outputs that are stored in notebooks, because they do not contain the states of panels.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TypedDict

from course_pkg.authoring.cells import Cell, Notebook, Output, code_cells
from course_pkg.authoring.notebook_store import read
from course_pkg.checking.parts import folders_for
from course_pkg.errors import AuthoringError
from course_pkg.files import write_atomically
from course_pkg.setup import CATKIN_FOLDERS, Places
from course_pkg.setup.stamps import digest
from course_pkg.site.recordings import embed_states, plans, with_recordings, without_recordings

# Notebooks do not use the modules in these folders. Therefore, a change of these modules causes no new run.
IDLE = (
    *("authoring", "chapters", "class_view", "grading", "handout", "hub", "installation", "lab", "sandbox"),
    *("setup", "site", "web_pages"),
)
RUN_BY = ("course_pkg/authoring/execute.py", "course_pkg/setup/locks/course.txt")


class Shown(TypedDict):
    """The stored outputs and the execution count of a code cell."""

    outputs: list[Output]
    execution_count: int | None


class Runs:
    """The stored runs of one checkout."""

    def __init__(self, places: Places | None = None) -> None:
        self._places = places or Places.of()
        self._shared = digest(self._package())

    def update(self, paths: Sequence[Path]) -> dict[Path, AuthoringError]:
        """Run each changed notebook again, and store its outputs; a change of a used file also counts.

        Several notebooks run at the same time. Returns the errors of the notebooks that stopped before their
        last cell.
        """
        # The import is here, because only a run needs nbclient.
        from course_pkg.authoring.execute import run_all
        from course_pkg.authoring.normalise import tidy

        new = {path.stem: path for path in paths if self._kept(path, "key", self._key(path)) is None}
        keys = {name: self._key(path) for name, path in new.items()}

        def keep(name: str, executed: Notebook) -> None:
            notebook = without_recordings(executed)
            embed_states(notebook)
            tidy(notebook)
            shown = [_shown(cell) for cell in code_cells(notebook)]
            record = {"key": keys[name], "code": _code(notebook), "shown": shown}
            write_atomically(self._file(new[name]), json.dumps(record, ensure_ascii=False))

        notebooks = {name: with_recordings(name, read(path)) for name, path in new.items()}
        errors = run_all(notebooks, keep) if notebooks else {}
        return {new[name]: error for name, error in errors.items()}

    def latest(self, path: Path) -> Notebook | None:
        """Return the notebook with the outputs of its last run.

        If there is no run with the current code, return None.

        The last run may have used an older version of the package.
        """
        notebook = read(path)
        shown = self._kept(path, "code", _code(notebook))
        return _with(notebook, shown) if shown is not None else None

    def _kept(self, path: Path, name: str, value: str) -> list[Shown] | None:
        try:
            record = json.loads(self._file(path).read_text("utf-8"))
        except (OSError, ValueError):
            return None
        shown: list[Shown] = record["shown"]
        return shown if record[name] == value else None

    def _file(self, path: Path) -> Path:
        return self._places.cache / "site" / path.parent.name / f"{path.stem}.json"

    def _key(self, path: Path) -> str:
        own = (file for folder in folders_for(path.name[:2]) for file in folder.rglob("*"))
        planned = json.dumps(plans(path.stem), sort_keys=True)
        return digest([self._shared, _code(read(path)), planned, *_contents(own)])

    def _package(self) -> Iterator[str | bytes]:
        """Yield the contents of all files that a notebook can run, read or import.

        The checks of the chapters are omitted; `_key` adds the checks of the notebook's own chapter.
        """
        root = self._places.checkout
        yield sys.version
        yield from ((root / name).read_bytes() for name in RUN_BY)
        for folder in (*sorted((root / "course_pkg").iterdir()), *(root / name for name in CATKIN_FOLDERS)):
            if folder.is_dir() and folder.name not in IDLE:
                yield from _contents(file for file in folder.rglob("*") if "checks" not in file.parts)


def _contents(files: Iterable[Path]) -> Iterator[str | bytes]:
    for file in sorted(files):
        if file.is_file() and "__pycache__" not in file.parts:
            yield str(file)
            yield file.read_bytes()


def _code(notebook: Notebook) -> str:
    """Return a digest of the code cells.

    The digest does not depend on the prose, so a change of prose causes no new run.
    """
    return digest(cell["source"] for cell in code_cells(notebook))


def _shown(cell: Cell) -> Shown:
    return {"outputs": cell["outputs"], "execution_count": cell["execution_count"]}


def _with(notebook: Notebook, shown: Sequence[Shown]) -> Notebook:
    for cell, each in zip(code_cells(notebook), shown, strict=True):
        cell["outputs"], cell["execution_count"] = each["outputs"], each["execution_count"]
    return notebook
