"""A normalised notebook contains no data that differ between two runs."""

from __future__ import annotations

import copy

import nbformat

from course_pkg.authoring.normalise import strip, tidy
from course_pkg.authoring.notebook_store import text_of
from course_pkg.authoring.widgets import VIEW
from course_pkg.ros.notebook.tracebacks import HEADER
from tests.authoring.books import book, check, code, exercise, text


def stream(words: str, name: str = "stdout") -> dict[str, str]:
    """Return a cell output of the type `stream`."""
    return {"output_type": "stream", "name": name, "text": words}


def test_a_second_normalisation_changes_nothing() -> None:
    """A second call of `tidy` does not change the notebook."""
    data = {"text/plain": "Panel()", VIEW: {"model_id": "0123"}}
    shown = {"output_type": "execute_result", "data": data, "metadata": {VIEW: {}}, "execution_count": 77}
    cell = code(
        "panel", outputs=[stream("a"), stream("b\n"), stream("c", "stderr"), shown], execution_count=77
    )
    cell["metadata"] = {"collapsed": True, "execution": {"iopub.execute_input": "2026"}, "tags": ["x"]}
    notebook = book(text("# Go", "no id!"), code("", id="b"), cell, exercise(), check())
    notebook["metadata"] = {
        "widgets": {"state": {}},
        "language_info": {"name": "python", "version": "3.11.2"},
    }
    tidy(notebook)
    once = text_of(notebook)
    tidy(notebook)
    assert text_of(notebook) == once
    assert once.endswith("}\n")
    nbformat.validate(nbformat.reads(once, as_version=4))


def test_only_parts_that_differ_between_runs_are_removed() -> None:
    """`tidy` removes widget ids and timings from a notebook, but no texts and no tags."""
    data = {"text/plain": "Panel()", VIEW: {"model_id": "0123"}}
    shown = {"output_type": "display_data", "data": data, "metadata": {}}
    cell = code("panel", outputs=[stream("a"), stream("b\n"), shown], execution_count=77, tags=["x"])
    cell["metadata"]["execution"] = {"at": "2026"}
    notebook = book(cell)
    notebook["metadata"] = {"widgets": {}, "kernelspec": {"name": "my-venv"}}
    tidy(notebook)
    assert cell["outputs"][0]["text"] == "ab\n"
    assert cell["outputs"][1]["data"] == {"text/plain": "Panel()"}
    assert cell["execution_count"] == 1
    assert cell["metadata"] == {"tags": ["x"]}
    assert notebook["metadata"]["kernelspec"]["name"] == "python3"
    assert "widgets" not in notebook["metadata"]


def test_a_readable_traceback_stays() -> None:
    """`tidy` does not change a traceback without file paths, such as the short traceback of the course."""
    lines = [HEADER, "  This cell, line 1", "    fail()", "E: v"]
    cell = code("fail()", outputs=[{"output_type": "error", "ename": "E", "evalue": "v", "traceback": lines}])
    tidy(book(cell))
    assert cell["outputs"][0]["traceback"] == lines


def test_another_traceback_is_reduced_to_its_last_line() -> None:
    """If a traceback contains file paths, `tidy` keeps only the line with the error message."""
    error = {"output_type": "error", "ename": "E", "evalue": "v", "traceback": ["File /home/me/x.py", "E: v"]}
    cell = code("fail()", outputs=[error], execution_count=1)
    tidy(book(cell))
    assert cell["outputs"][0]["traceback"] == ["E: v"]


def test_every_cell_gets_a_unique_id() -> None:
    """`tidy` gives each cell a unique and valid id."""
    notebook = book(text("a", "same"), text("b", "same"), text("c", "not valid!"), exercise(), check())
    notebook["cells"][3]["id"] = "whatever"
    tidy(notebook)
    names = [cell["id"] for cell in notebook["cells"]]
    assert names[:2] == ["same", "same-2"]
    assert names[2].startswith("cell-")
    assert names[3:] == ["exercise-05-1", "check-05-1"]


def test_strip_removes_every_output() -> None:
    """A stripped cell has no outputs and no execution count, and its source does not change."""
    cell = code("1", outputs=[stream("1")], execution_count=3)
    notebook = book(cell)
    before = copy.deepcopy(cell["source"])
    strip(notebook)
    assert (cell["outputs"], cell["execution_count"], cell["source"]) == ([], None, before)
