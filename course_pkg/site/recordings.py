"""What is recorded of a panel while its notebook runs, so that the site's page has something to show.

The file `recordings.json` of the chapter holds a plan for a cell, by the cell's id. `record` lists the
requests that a service panel makes, or the cases of BreakIt with the tools to use in each; the page answers
from them. `pick` names the service where the cell names none. `watch` says for how many seconds a panel does
what it otherwise does only while a page shows it. Meanwhile the notebook's own node makes the `calls`: the
name of a service, its type, and the fields of the request.
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
    """What is recorded of one panel."""

    pick: str
    record: Sequence[Plain]
    watch: float  # s
    calls: Sequence[tuple[str, str, Mapping[str, float]]]


class Panel(Protocol):
    """What a plan uses of a panel; each panel has the methods that its plans need."""

    def received(self, kind: str, content: Mapping[str, Plain]) -> None:
        """Handle a message of the front end."""

    def record(self, requests: Sequence[Plain]) -> None:
        """Record the responses."""

    def shown(self) -> None:
        """Begin the work of a panel that a page shows."""

    def hidden(self) -> None:
        """End that work."""


def plans(name: str) -> dict[str, Plan]:
    """Return the plans of the notebook called `name`, by cell."""
    path = folder_of(name[:2]) / "recordings.json"
    planned: dict[str, Plan] = json.loads(path.read_text("utf-8")) if path.exists() else {}
    return planned


def with_recordings(name: str, notebook: Notebook) -> Notebook:
    """Return `notebook` with a cell for each plan, below the cell that shows the panel."""
    planned = plans(name)
    cells: list[Cell] = []
    for cell in notebook["cells"]:
        cells.append(cell)
        if plan := planned.get(cell["id"]):
            cells.append(_recording(cell, plan))
    return {**notebook, "cells": cells}


def without_recordings(notebook: Notebook) -> Notebook:
    """Return `notebook` without the cells that were added."""
    return {**notebook, "cells": [cell for cell in notebook["cells"] if "recording" not in cell["metadata"]]}


def record_panel(panel: Panel, plan: Plan) -> None:
    """Do what `plan` says, in the notebook's kernel; a service without a server leaves no recording."""
    if "pick" in plan:
        panel.received("pick", {"service": plan["pick"]})
    if "record" in plan:
        with suppress(CourseError):  # a student's notebook has no server yet where the solution has one
            panel.record(plan["record"])
    if "watch" in plan:
        panel.shown()
        _call_during(plan["watch"], plan.get("calls", ()))
        panel.hidden()


def _call_during(seconds: float, calls: Sequence[tuple[str, str, Mapping[str, float]]]) -> None:
    """Let so much time pass, and make the calls in it at equal intervals."""
    from course_pkg.ros import this_node  # with rospy, which the site does not need otherwise

    for name, kind, fields in calls:
        time.sleep(seconds / (len(calls) + 1))
        if node := this_node():
            with suppress(CourseError):  # as above
                node.call(name, kind, **fields)
    time.sleep(seconds / (len(calls) + 1))


def _recording(shown: Cell, plan: Plan) -> Cell:
    """Return a cell that records the panel of the cell above it, and that defines no name.

    IPython keeps the panel among its results. The cell cannot use `_`, because a notebook may have a variable
    of that name.
    """
    added = copy.deepcopy(shown)
    added["id"] = f"recording-{shown['id']}"[:64]
    added["metadata"] = {"recording": True}
    added["source"] = (
        f'__import__("{__name__}", fromlist=["_"]).record_panel([*_oh.values()][-1], {dict(plan)!r})'
    )
    return added


def embed_states(notebook: Notebook) -> None:
    """Replace each view of a panel in `notebook` by the panel and its last state; remove all other views."""
    panels = SavedPanels(notebook)
    notebook["metadata"].pop("widgets", None)
    for cell in code_cells(notebook):
        for output in cell["outputs"]:
            panel = panels.of(output)
            output.get("data", {}).pop(VIEW, None)
            if panel:
                output["data"][PANEL] = {"panel": panel.name, "state": panel.state}
