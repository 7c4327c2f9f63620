"""Helpers that make small courses for the tests of sites."""

from __future__ import annotations

import json
from pathlib import Path

from course_pkg.authoring.cells import Cell, Output
from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.setup import Places
from course_pkg.site.exporter import Body, Exporter
from course_pkg.site.runs import Runs
from course_pkg.types import Plain
from tests.authoring.books import book, code, text

FIRST = "# Try a panel\n\nA lead.\n\n**You will** see one.\n\n**You need** nothing.\n\n**Time**: 5 minutes."


def store(root: Path, **chapters: list[Cell]) -> NotebookStore:
    """Write a solution and a notebook with the same cells for each chapter; return the NotebookStore.

    An argument such as `_00_name` contains the cells of a chapter; the chapter's name is 00_name.
    """
    for folder in ("solutions", "notebooks"):
        (root / folder).mkdir(parents=True, exist_ok=True)
        for name, cells in chapters.items():
            notebook = book(text(FIRST, "title"), *cells)
            (root / folder / f"{name.strip('_')}.ipynb").write_text(json.dumps(notebook), "utf-8")
    return NotebookStore(root)


def runs(cache: Path) -> Runs:
    """Return the object that stores the chapters' runs in a folder."""
    return Runs(Places(Places.of().checkout, cache))


def shown(*outputs: Output) -> Body:
    """Return the body of a page that shows the given outputs."""
    return Exporter().body(book(code("show()", outputs=list(outputs))))


def result(**data: Plain) -> Output:
    """Return a cell's result. The argument `text_html="…"` sets the data for the MIME type text/html."""
    kinds = {name.replace("_", "/", 1): value for name, value in data.items()}
    return {"output_type": "execute_result", "execution_count": 1, "metadata": {}, "data": kinds}
