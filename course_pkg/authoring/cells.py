"""Reads the cells of a notebook, and the course's keys in their metadata.

No other module reads or writes these keys.

In the metadata of an exercise cell, `course.exercise` is the id of the part, such as "05.1", and
`course.points` is the number of points. In the metadata of a check cell, `course.check` is the id of the
part. A cell that shows an error on purpose has the tag `raises-exception`.
"""

from __future__ import annotations

from typing import TypedDict

from course_pkg.types.fields import Plain


class CourseMetadata(TypedDict, total=False):
    """The course's own metadata of a cell."""

    exercise: str
    check: str
    points: int


class CellMetadata(TypedDict, total=False):
    """The keys of a cell's metadata that the course uses."""

    course: CourseMetadata
    tags: list[str]
    # `recording` is True for a cell that the site build adds to a notebook to record panels.
    recording: bool


class Output(TypedDict, total=False):
    """An output of a code cell (nbformat 4). The keys depend on `output_type`."""

    output_type: str  # The value is "stream", "execute_result", "display_data" or "error".
    name: str
    text: str
    data: dict[str, Plain]  # The keys are MIME types.
    metadata: dict[str, dict[str, str]]  # The keys are MIME types.
    execution_count: int | None
    ename: str
    evalue: str
    traceback: list[str]


class Cell(TypedDict, total=False):
    """A cell (nbformat 4); only a code cell has `outputs` and `execution_count`."""

    id: str
    cell_type: str  # The value is "code", "markdown" or "raw".
    metadata: CellMetadata
    source: str
    outputs: list[Output]
    execution_count: int | None


class WidgetModel(TypedDict, total=False):
    """One saved widget."""

    state: dict[str, Plain]  # `state` contains the traits of the widget.
    buffers: list[dict[str, Plain]]


class WidgetModels(TypedDict):
    """The saved widgets of a notebook; each key is the model id of a widget."""

    state: dict[str, WidgetModel]


class NotebookMetadata(TypedDict, total=False):
    """The metadata of a notebook."""

    title: str
    kernelspec: dict[str, str]
    language_info: dict[str, str]
    widgets: dict[str, WidgetModels]  # The keys are MIME types.


class Notebook(TypedDict, total=False):
    """A notebook (nbformat 4); each text is one string, not a list of lines."""

    cells: list[Cell]
    metadata: NotebookMetadata
    nbformat: int
    nbformat_minor: int


def exercise_of(cell: Cell) -> str:
    """Return the id of the part to which an exercise cell belongs, or "" for any other cell."""
    return str(_course(cell).get("exercise", ""))


def check_of(cell: Cell) -> str:
    """Return the id of the part that a check cell checks, or "" for any other cell."""
    return str(_course(cell).get("check", ""))


def points_of(cell: Cell) -> int | None:
    """Return the points of an exercise cell, or None if its metadata have no points."""
    points = _course(cell).get("points")
    return points if isinstance(points, int) else None


def may_raise(cell: Cell) -> bool:
    """Return whether the cell shows an error on purpose."""
    return "raises-exception" in cell["metadata"].get("tags", [])


def code_cells(notebook: Notebook) -> list[Cell]:
    """Return the code cells of the notebook `notebook`, in their order."""
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def not_passed(notebook: Notebook) -> dict[str, str]:
    """Return the stored report of each check that did not pass; the keys are the ids of the parts."""
    reports = {check: _plain_text(cell) for cell in code_cells(notebook) if (check := check_of(cell))}
    return {check: text for check, text in reports.items() if not text.startswith(f"{check} passed")}


def _plain_text(cell: Cell) -> str:
    """Return the `text/plain` outputs of the cell; printed text is not included."""
    texts = (output.get("data", {}).get("text/plain", "") for output in cell["outputs"])
    return "\n".join(str(text) for text in texts if text)


def _course(cell: Cell) -> CourseMetadata:
    course = cell["metadata"].get("course", {})
    return course if isinstance(course, dict) else {}
