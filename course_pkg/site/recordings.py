"""Records panels while a notebook runs; the site can then show real responses without a kernel.

A chapter's file `recordings.json` contains plans for some cells; each key is the id of a cell. A plan has
these keys:

- `record`: for a service panel, the requests to send; for BreakIt, the names of faults, each with the tools
  to run. The page answers with the recorded responses.
- `pick`: the name of the service, if the code of the cell does not name a service.
- `watch`: the time in s during which the panel works as if it were visible on a page.
- `calls`: the calls that the notebook's own node makes during these seconds. Each call has the name of a
  service, its type, and the fields of the request.
"""

from __future__ import annotations

import copy
import json
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Protocol, TypedDict

from course_pkg.authoring.cells import Cell, Notebook, code_cells
from course_pkg.authoring.widgets import VIEW, SavedPanels
from course_pkg.checking.parts import folder_of
from course_pkg.errors import CourseError
from course_pkg.types.fields import Plain

PANEL = "application/vnd.course-panel+json"


class Plan(TypedDict, total=False):
    """The plan for the recording of one panel."""

    pick: str
    record: Sequence[Plain]
    watch: float  # The time is in s.
    calls: Sequence[tuple[str, str, Mapping[str, float]]]


class Panel(Protocol):
    """The methods of a panel that a plan may call; a panel needs only the methods that its plan uses."""

    def received(self, kind: str, content: Mapping[str, Plain]) -> None:
        """Handle a message in the same way as a message from the front end."""

    def record(self, requests: Sequence[Plain]) -> None:
        """Send the requests to the service, and record the responses."""

    def shown(self) -> None:
        """Start the work that the panel does while a page shows it."""

    def hidden(self) -> None:
        """Stop the work that `shown` started."""


def plans(name: str) -> dict[str, Plan]:
    """Return the plans for the notebook called `name`; the keys are the ids of cells."""
    path = folder_of(name[:2]) / "recordings.json"
    planned: dict[str, Plan] = json.loads(path.read_text("utf-8")) if path.exists() else {}
    return planned


def with_recordings(name: str, notebook: Notebook) -> Notebook:
    """Return a copy of the notebook with a recording cell for each plan, below the panel's cell."""
    planned = plans(name)
    cells: list[Cell] = []
    for cell in notebook["cells"]:
        cells.append(cell)
        if plan := planned.get(cell["id"]):
            cells.append(_recording(cell, plan))
    return {**notebook, "cells": cells}


def without_recordings(notebook: Notebook) -> Notebook:
    """Return a copy of the notebook `notebook` without the cells that `with_recordings` added."""
    return {**notebook, "cells": [cell for cell in notebook["cells"] if "recording" not in cell["metadata"]]}


def record_panel(panel: Panel, plan: Plan) -> None:
    """Record a panel according to the plan; this function runs in the notebook's kernel.

    A call to a service without a server is not recorded.
    """
    if "pick" in plan:
        panel.received("pick", {"service": plan["pick"]})
    if "record" in plan:
        with suppress(CourseError):  # In a student's notebook, the server is often not written yet.
            panel.record(plan["record"])
    if "watch" in plan:
        panel.shown()
        _call_during(plan["watch"], plan.get("calls", ()))
        panel.hidden()


def _call_during(seconds: float, calls: Sequence[tuple[str, str, Mapping[str, float]]]) -> None:
    """Make the calls at equal intervals; `seconds` is the total time in s."""
    # The import is here, because only a recording with calls needs rospy.
    from course_pkg.ros import this_node

    for name, kind, fields in calls:
        time.sleep(seconds / (len(calls) + 1))
        if node := this_node():
            with suppress(CourseError):  # In a student's notebook, the server is often not written yet.
                node.call(name, kind, **fields)
    time.sleep(seconds / (len(calls) + 1))


def _recording(shown: Cell, plan: Plan) -> Cell:
    """Return a cell that records the panel of the cell above; the new cell defines no variable.

    The new cell reads the panel from `_oh`, IPython's dict of results. It cannot use `_`, because a notebook
    may define a variable with this name.
    """
    added = copy.deepcopy(shown)
    added["id"] = f"recording-{shown['id']}"[:64]
    added["metadata"] = {"recording": True}
    added["source"] = (
        f'__import__("{__name__}", fromlist=["_"]).record_panel([*_oh.values()][-1], {dict(plan)!r})'
    )
    return added


def embed_states(notebook: Notebook) -> None:
    """Replace each output that shows a panel with the panel's last state; remove all other widgets."""
    panels = SavedPanels(notebook)
    notebook["metadata"].pop("widgets", None)
    for cell in code_cells(notebook):
        for output in cell["outputs"]:
            panel = panels.of(output)
            output.get("data", {}).pop(VIEW, None)
            if panel:
                output["data"][PANEL] = {"panel": panel.name, "state": panel.state}
