"""Small notebooks to try the authoring on."""

from __future__ import annotations

from typing import Any

EXERCISE = "def handle_geometry(request):\n    return request.width, 1"


def code(source: str, **more: Any) -> dict[str, Any]:  # noqa: ANN401
    """Return a code cell; `course` and `tags` go into its metadata."""
    metadata = {key: more.pop(key) for key in ("course", "tags") if key in more}
    cell = {"cell_type": "code", "id": more.pop("id", "a"), "metadata": metadata, "source": source}
    return {**cell, "outputs": [], "execution_count": None, **more}


def text(source: str, name: str = "t") -> dict[str, Any]:
    """Return a Markdown cell."""
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": source}


def exercise(part: str = "05.1", points: int | None = 2, source: str = EXERCISE) -> dict[str, Any]:
    """Return an exercise cell."""
    course = {"exercise": part, **({} if points is None else {"points": points})}
    return code(source, id=f"exercise-{part.replace('.', '-')}", course=course)


def check(part: str = "05.1") -> dict[str, Any]:
    """Return a check cell."""
    return code(f'check("{part}")', id=f"check-{part.replace('.', '-')}", course={"check": part})


def book(*cells: dict[str, Any]) -> dict[str, Any]:
    """Return a notebook of `cells`."""
    return {"cells": list(cells), "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
