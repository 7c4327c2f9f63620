"""Small courses to build a site of, and what a test does on a page."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from course_pkg.authoring.shelf import Shelf
from course_pkg.provision import Places
from course_pkg.site.exporter import Body, Exporter
from course_pkg.site.runs import Runs
from tests.authoring.books import book, code, text

FIRST = "# Try a panel\n\nA lead.\n\n**You will** see one.\n\n**You need** nothing.\n\n**Time**: 5 minutes."
Cell = dict[str, Any]


def shelf(root: Path, **chapters: list[Cell]) -> Shelf:
    """Write solutions, and the same as notebooks; `_00_name=[…]` are a chapter's cells below its title."""
    for folder in ("solutions", "notebooks"):
        (root / folder).mkdir(parents=True, exist_ok=True)
        for name, cells in chapters.items():
            notebook = book(text(FIRST, "title"), *cells)
            (root / folder / f"{name.strip('_')}.ipynb").write_text(json.dumps(notebook), "utf-8")
    return Shelf(root)


def runs(cache: Path) -> Runs:
    """Return the runs of this checkout's package, kept in a folder of their own."""
    return Runs(Places(Places.of().checkout, cache))


def shown(*outputs: dict[str, Any]) -> Body:
    """Return the body of a page with one cell that shows `outputs`."""
    return Exporter().body(book(code("show()", outputs=list(outputs))))


def result(**data: Any) -> dict[str, Any]:  # noqa: ANN401
    """Return the result of a cell; `text_html="…"` is its form as text/html."""
    kinds = {name.replace("_", "/", 1): value for name, value in data.items()}
    return {"output_type": "execute_result", "execution_count": 1, "metadata": {}, "data": kinds}
