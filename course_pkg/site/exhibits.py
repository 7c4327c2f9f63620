"""Panels as a page keeps them: which panel, and the state that it had when its notebook ended.

A saved widget carries its own script. It is left behind: a page draws with the scripts of this package, so
that nothing that a kernel sent can run in it. A widget of another kind is no exhibit, and shows its words.
"""

from __future__ import annotations

import re
from typing import Any

from course_pkg.authoring.cells import Notebook, code_cells

EXHIBIT = "application/vnd.course-panel+json"
VIEW = "application/vnd.jupyter.widget-view+json"
STATES = "application/vnd.jupyter.widget-state+json"
PRIVATE = ("layout", "tabbable", "tooltip")  # traits of ipywidgets
OF_THE_COURSE = re.compile(r"course_pkg\.panels\.(?P<panel>\w+)\.view\.\w+")

State = dict[str, Any]


def set_out(notebook: Notebook) -> None:
    """Replace each view of a panel in `notebook` by the panel and its last state; drop all other views."""
    saved = notebook["metadata"].pop("widgets", {}).get(STATES, {}).get("state", {})
    for cell in code_cells(notebook):
        for output in cell["outputs"]:
            if view := output.get("data", {}).pop(VIEW, None):
                _set_out(output, saved.get(view["model_id"], {}))


def _set_out(output: dict[str, Any], model: State) -> None:
    state = model.get("state", {})
    if (panel := _panel_of(state)) and not model.get("buffers"):
        output["data"][EXHIBIT] = {"panel": panel, "state": _kept(state)}


def _panel_of(state: State) -> str:
    found = OF_THE_COURSE.fullmatch(str(state.get("_anywidget_id", "")))
    return found["panel"] if found else ""


def _kept(state: State) -> State:
    """Return what a front end reads."""
    return {name: value for name, value in state.items() if name[0] != "_" and name not in PRIVATE}
