"""Makes small notebooks for the tests of the authoring tools."""

from __future__ import annotations

from course_pkg.authoring.cells import Cell, Notebook
from course_pkg.types import Plain

EXERCISE = "def handle_geometry(request):\n    return request.width, 1"


def code(source: str, **more: Plain) -> Cell:
    """Return a code cell; the arguments `course` and `tags` become entries of the cell's metadata."""
    metadata = {key: more.pop(key) for key in ("course", "tags") if key in more}
    cell = {"cell_type": "code", "id": more.pop("id", "a"), "metadata": metadata, "source": source}
    return {**cell, "outputs": [], "execution_count": None, **more}


def text(source: str, name: str = "t") -> Cell:
    """Return a Markdown cell."""
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": source}


def exercise(part: str = "05.1", points: int | None = 2, source: str = EXERCISE) -> Cell:
    """Return an exercise cell."""
    course = {"exercise": part, **({} if points is None else {"points": points})}
    return code(source, id=f"exercise-{part.replace('.', '-')}", course=course)


def check(part: str = "05.1") -> Cell:
    """Return a check cell."""
    return code(f'check("{part}")', id=f"check-{part.replace('.', '-')}", course={"check": part})


def book(*cells: Cell) -> Notebook:
    """Return a notebook with the given cells."""
    return {"cells": list(cells), "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
