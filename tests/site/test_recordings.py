"""Tests of recording panels while a chapter runs for the site."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Notebook, code_cells
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.authoring.widgets import STATES, VIEW
from course_pkg.errors import CourseError, NoServiceSelected
from course_pkg.site.pages import HERE
from course_pkg.site.recordings import (
    PANEL,
    embed_states,
    plans,
    record_panel,
    with_recordings,
    without_recordings,
)
from course_pkg.types import Plain
from tests.authoring.books import book, code
from tests.site.notebook_stores import result


class Noted:
    """A fake panel that stores the calls of its methods in `done`.

    `record` raises the error `trouble`, unless `trouble` is None.
    """

    def __init__(self, trouble: CourseError | None = None) -> None:
        self.done: list[str | list[dict[str, Plain]] | tuple[str, dict[str, Plain]]] = []
        self.trouble = trouble

    def received(self, kind: str, content: dict[str, Plain]) -> None:
        """Store a message from the front end."""
        self.done.append((kind, content))

    def record(self, requests: list[dict[str, Plain]]) -> None:
        """Store the requests, and raise `trouble` if it is not None."""
        self.done.append(requests)
        if self.trouble:
            raise self.trouble

    def shown(self) -> None:
        """Record that the panel is shown."""
        self.done.append("shown")

    def hidden(self) -> None:
        """Record that the panel is no longer shown."""
        self.done.append("hidden")


@pytest.mark.parametrize("trouble", [None, NoServiceSelected("There is no server.")])
def test_a_service_is_picked_before_it_is_recorded(trouble: CourseError | None) -> None:
    """The recording selects the service before it records the requests.

    If the recording fails, the notebook continues.
    """
    panel = Noted(trouble)
    record_panel(panel, {"pick": "/add_two_ints", "record": [{"a": 1, "b": 2}]})
    assert panel.done == [("pick", {"service": "/add_two_ints"}), [{"a": 1, "b": 2}]]


def test_a_panel_is_shown_for_a_while() -> None:
    """If the recording plan contains the time `watch`, the panel is shown for this time and then hidden."""
    panel = Noted()
    record_panel(panel, {"watch": 0, "calls": [["/switch/report", "std_srvs/Trigger", {}]]})
    assert panel.done == ["shown", "hidden"]


def test_the_panel_is_found_even_if_a_notebook_uses_the_name_underscore() -> None:
    """The recording cell finds the panel in `_oh`, because a notebook may assign to the variable `_`."""
    notebook = book(code("for _ in range(2): pass"), code("GraphPanel()", id="graphpanel"))
    added = with_recordings("00_start_the_graph", notebook)["cells"][-1]
    panel, results = Noted(), {1: "earlier"}
    names = {"_": 1, "_oh": results | {2: panel}, "__builtins__": __builtins__}
    exec(re.sub(r"'watch': \d+", "'watch': 0", added["source"]), names)  # noqa: S102 -- code of the course
    assert panel.done == ["shown", "hidden"]


ROOT = NotebookStore().root
SYSTEMS = json.loads((HERE / "systems.json").read_text("utf-8"))


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_each_plan_belongs_to_a_cell_with_a_panel(path: Path) -> None:
    """For each recording plan, the last line of its cell creates a panel that fits the plan."""
    for folder in ("solutions", "notebooks"):
        cells = {cell["id"]: cell["source"] for cell in code_cells(read(ROOT / folder / path.name))}
        for cell, plan in plans(path.stem).items():
            panels = ("ServicePanel(", "BreakIt(") if "record" in plan else ("TopicPanel(", "GraphPanel(")
            shown = cells[cell].rpartition("\n")[2]
            assert shown.startswith(panels)
            assert ("pick" in plan) == (shown == "ServicePanel()")


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_the_added_cells_are_removed_again(path: Path) -> None:
    """`without_recordings` removes exactly the cells that `with_recordings` added."""
    notebook = read(path)
    assert without_recordings(with_recordings(path.stem, notebook)) == notebook


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda system: system["name"])
def test_the_command_of_each_system_exists(system: dict[str, str]) -> None:
    """Each command on the start page starts an existing launch file or program."""
    tool, package, name, *_ = system["start"].split()
    folders = {"course_pkg": "nodes/ chapters/*/programs/", "turtlesim": "turtlesim/"}[package].split()
    programs = [found for folder in folders for found in (ROOT / "course_pkg").glob(f"{folder}{name}.py")]
    assert (ROOT / "launch" / name).exists() if tool == "roslaunch" else programs


GRAPH = "course_pkg.panels.graph.view.GraphPanel"


def saved(kind: str, **state: Plain) -> Notebook:
    """Return a notebook with one output, a widget with the given class and traits."""
    view = result(text_plain="GraphPanel()")
    view["data"][VIEW] = {"model_id": "m"}
    notebook = book(code("GraphPanel()", outputs=[view]))
    model = {"state": {"_anywidget_id": kind, "_esm": "alert(1)", "_css": "*{}", "layout": "L", **state}}
    notebook["metadata"]["widgets"] = {STATES: {"state": {"m": model}}}
    return notebook


def data(notebook: Notebook) -> dict[str, Plain]:
    """Return the data of the notebook's first output; the keys are the MIME types."""
    held: dict[str, Plain] = notebook["cells"][0]["outputs"][0]["data"]
    return held


def test_a_panel_is_kept_without_its_script() -> None:
    """The output for a saved panel contains the panel's name and state, but no script."""
    notebook = saved(GRAPH, data={"x": 1})
    embed_states(notebook)
    assert data(notebook) == {
        "text/plain": "GraphPanel()",
        PANEL: {"panel": "graph", "state": {"data": {"x": 1}}},
    }
    assert "widgets" not in notebook["metadata"]


def test_a_widget_of_another_library_is_shown_as_text() -> None:
    """For a widget of another library, the page shows the text of the widget."""
    for kind in ("elsewhere.Widget", "course_pkg.panels.graph.view.GraphPanel2.x", "", f"{GRAPH}\n"):
        notebook = saved(kind)
        embed_states(notebook)
        assert data(notebook) == {"text/plain": "GraphPanel()"}


def test_a_view_without_a_state_is_shown_as_text() -> None:
    """If a widget has no saved state, the page shows the text of the widget."""
    notebook = saved(GRAPH)
    notebook["metadata"] = {}
    embed_states(notebook)
    assert data(notebook) == {"text/plain": "GraphPanel()"}
