"""Removes the data that differ between two runs of a notebook, or between JupyterLab and other front ends.

Printed addresses, ports, times and process ids are content of the chapter, so they are not removed.
"""

from __future__ import annotations

import hashlib
import re

from course_pkg.authoring.cells import (
    Cell,
    CellMetadata,
    Notebook,
    NotebookMetadata,
    Output,
    check_of,
    code_cells,
    exercise_of,
)
from course_pkg.authoring.widgets import VIEW
from course_pkg.ros.notebook.tracebacks import HEADER

VALID_ID = re.compile(r"[a-zA-Z0-9_-]{1,64}")
METADATA: NotebookMetadata = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def tidy(notebook: Notebook) -> None:
    """Normalise the notebook itself, not a copy. A second call has no effect."""
    notebook["nbformat"], notebook["nbformat_minor"] = 4, 5
    title = notebook["metadata"].get("title")
    notebook["metadata"] = {**METADATA, "title": title} if title else {**METADATA}
    _name(notebook["cells"])
    for cell in notebook["cells"]:
        cell["metadata"] = _kept(cell["metadata"])
    written = [cell for cell in code_cells(notebook) if cell["source"].strip()]
    for number, cell in enumerate(written, 1):
        _number(cell, number)
        cell["outputs"] = _merged([_output(output) for output in cell["outputs"]])


def strip(notebook: Notebook) -> None:
    """Remove every output and every execution count from the notebook itself, not from a copy."""
    for cell in code_cells(notebook):
        cell["outputs"], cell["execution_count"] = [], None


def _name(cells: list[Cell]) -> None:
    """Give each cell a valid and unique id; a second call does not change the ids."""
    taken: set[str] = set()
    for cell in cells:
        wanted = _wanted_id(cell)
        name, number = wanted, 2
        while name in taken:
            name, number = f"{wanted[:60]}-{number}", number + 1
        taken.add(name)
        cell["id"] = name


def _wanted_id(cell: Cell) -> str:
    if part := exercise_of(cell):
        return f"exercise-{part.replace('.', '-')}"
    if part := check_of(cell):
        return f"check-{part.replace('.', '-')}"
    name = str(cell.get("id", ""))
    if VALID_ID.fullmatch(name):
        return name
    return f"cell-{hashlib.sha256(cell['source'].encode()).hexdigest()[:8]}"


def _kept(metadata: CellMetadata) -> CellMetadata:
    kept = CellMetadata()
    if "course" in metadata:
        kept["course"] = metadata["course"]
    if "tags" in metadata:
        kept["tags"] = metadata["tags"]
    return kept


def _number(cell: Cell, number: int) -> None:
    """Set the execution count of an executed cell to `number`; do not change other cells.

    The cells get increasing numbers, even if they ran in another order.
    """
    if cell["execution_count"] is None and not cell["outputs"]:
        return
    cell["execution_count"] = number
    for output in cell["outputs"]:
        if output["output_type"] == "execute_result":
            output["execution_count"] = number


def _output(output: Output) -> Output:
    if output["output_type"] == "error" and output["traceback"][:1] != [HEADER]:
        # IPython's traceback contains local paths, so remove it. A traceback of the course contains only
        # lines of cells, so do not remove it.
        output["traceback"] = [f"{output['ename']}: {output['evalue']}"]
    if "data" in output:
        output["data"] = {kind: data for kind, data in output["data"].items() if kind != VIEW}
        output["metadata"] = {kind: data for kind, data in output["metadata"].items() if kind != VIEW}
    return output


def _merged(outputs: list[Output]) -> list[Output]:
    """Join successive outputs of the same stream, because the number of outputs can differ between runs."""
    merged: list[Output] = []
    for output in outputs:
        last = merged[-1] if merged else Output()
        if output["output_type"] == "stream" and output["name"] == last.get("name"):
            last["text"] += output["text"]
        else:
            merged.append(output)
    return merged
