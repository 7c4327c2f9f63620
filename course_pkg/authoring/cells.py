"""What the metadata of a cell says about it; the one place that knows the keys.

An exercise cell:  {"course": {"exercise": "05.1", "points": 2}}
Its check cell:    {"course": {"check": "05.1"}}
A cell that shows an error on purpose carries the tag `raises-exception`.
"""

from __future__ import annotations

from typing import Any

Cell = dict[str, Any]
Notebook = dict[str, Any]


def exercise_of(cell: Cell) -> str:
    """Return the id of the part that this cell is the exercise of, or an empty text."""
    return str(_course(cell).get("exercise", ""))


def check_of(cell: Cell) -> str:
    """Return the id of the part that this cell checks, or an empty text."""
    return str(_course(cell).get("check", ""))


def points_of(cell: Cell) -> int | None:
    """Return the points of an exercise cell, or None when it does not say."""
    points = _course(cell).get("points")
    return points if isinstance(points, int) else None


def may_raise(cell: Cell) -> bool:
    """Return whether the cell shows an error on purpose."""
    return "raises-exception" in cell["metadata"].get("tags", [])


def code_cells(notebook: Notebook) -> list[Cell]:
    """Return the code cells, in order."""
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def _course(cell: Cell) -> dict[str, Any]:
    course = cell["metadata"].get("course", {})
    return course if isinstance(course, dict) else {}
