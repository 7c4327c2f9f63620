"""Notebooks as they ran: each is run once for its code and for what that runs on, and what it showed is kept.

The stored notebooks cannot serve: they hold no state of a panel, since that differs from run to run.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from course_pkg.authoring.cells import Notebook, code_cells
from course_pkg.authoring.shelf import read
from course_pkg.provision import CATKIN_FOLDERS, Places
from course_pkg.provision.stamps import digest, replace_text
from course_pkg.site.exhibits import set_out
from course_pkg.site.rehearsal import plans, rehearsed, without_rehearsal

# What no notebook runs: a change there is no reason to run one again.
IDLE = ("site", "grading", "lab", "authoring", "provision")
RUN_BY = ("course_pkg/authoring/execute.py", "course_pkg/provision/locks/course.txt")

Shown = list[dict[str, Any]]  # for each code cell its outputs and its number


class Runs:
    """The runs that are kept for one checkout."""

    def __init__(self, places: Places | None = None) -> None:
        self._places = places or Places.of()
        self._shared = digest(self._package())

    def of(self, path: Path) -> Notebook:
        """Return the notebook at `path` with what it shows; run it if its code, or what that needs, is new.

        Raises AuthoringError where the run fails.
        """
        notebook, key = read(path), self._key(path)
        shown = self._kept(path, "key", key)
        if shown is None:
            shown = self._run(path)
            record = {"key": key, "code": _code(notebook), "shown": shown}
            replace_text(self._file(path), json.dumps(record, ensure_ascii=False))
        return _with(notebook, shown)

    def latest(self, path: Path) -> Notebook | None:
        """Return the notebook as it ran last, even with another package; None if its code never ran."""
        notebook = read(path)
        shown = self._kept(path, "code", _code(notebook))
        return _with(notebook, shown) if shown is not None else None

    def _kept(self, path: Path, name: str, value: str) -> Shown | None:
        try:
            record = json.loads(self._file(path).read_text("utf-8"))
        except (OSError, ValueError):
            return None
        shown: Shown = record["shown"]
        return shown if record[name] == value else None

    def _run(self, path: Path) -> Shown:
        from course_pkg.authoring.execute import run  # with nbclient, which nothing else here needs
        from course_pkg.authoring.tidy import strip, tidy

        sys.stderr.write(f"{path.stem} or what it needs is new: it runs\n")
        notebook = rehearsed(path.stem, read(path))
        strip(notebook)
        run(path.stem, notebook)
        notebook = without_rehearsal(notebook)
        set_out(notebook)
        tidy(notebook)
        return [_shown(cell) for cell in code_cells(notebook)]

    def _file(self, path: Path) -> Path:
        return self._places.cache / "site" / path.parent.name / f"{path.stem}.json"

    def _key(self, path: Path) -> str:
        checks = self._places.checkout / "course_pkg" / "examiner" / "checks"
        own = (file for file in checks.rglob("*") if f"chapter_{path.name[:2]}" in str(file))
        planned = json.dumps(plans(path.stem), sort_keys=True)
        return digest([self._shared, _code(read(path)), planned, *_contents(own)])

    def _package(self) -> Iterator[str | bytes]:
        """Yield whatever a notebook can run, look at or import, except the checks of the chapters."""
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
    """Return a digest of what a run depends on. Prose may change without one."""
    return digest(cell["source"] for cell in code_cells(notebook))


def _shown(cell: dict[str, Any]) -> dict[str, Any]:
    return {"outputs": cell["outputs"], "execution_count": cell["execution_count"]}


def _with(notebook: Notebook, shown: Shown) -> Notebook:
    for cell, each in zip(code_cells(notebook), shown, strict=True):
        cell.update(each)
    return notebook
