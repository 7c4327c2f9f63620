"""The widgets of an executed notebook: the panel of each output, and the last state of each panel."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from course_pkg.authoring.cells import Notebook, Output
from course_pkg.types.fields import Plain

VIEW = "application/vnd.jupyter.widget-view+json"
STATES = "application/vnd.jupyter.widget-state+json"
OF_THE_COURSE = re.compile(r"course_pkg\.panels\.(?P<panel>\w+)\.view\.\w+")
PRIVATE = ("layout", "tabbable", "tooltip")  # traits of ipywidgets that a picture does not need


class SavedPanel(NamedTuple):
    """A panel of the course: the name of its folder in `course_pkg.panels`, and its traits."""

    name: str
    state: dict[str, Plain]


class SavedPanels:
    """The panels of an executed notebook, which nbclient saves in the notebook's metadata."""

    def __init__(self, notebook: Notebook) -> None:
        widgets = notebook["metadata"].get("widgets", {})
        self._models = widgets[STATES]["state"] if STATES in widgets else {}

    def of(self, output: Output) -> SavedPanel | None:
        """Return the panel that the output shows, or None if the output shows no panel of the course."""
        view = output.get("data", {}).get(VIEW)
        if not isinstance(view, Mapping):
            return None
        model = self._models.get(str(view["model_id"]), {})
        state = model.get("state", {})
        found = OF_THE_COURSE.fullmatch(str(state.get("_anywidget_id", "")))
        if not found or model.get("buffers"):
            return None
        read = {name: value for name, value in state.items() if name[0] != "_" and name not in PRIVATE}
        return SavedPanel(found["panel"], read)
