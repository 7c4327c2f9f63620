"""What is done with a panel while its notebook runs, so that the page has something to show.

`rehearsals.json` says it: for a notebook's name and a cell's id either `record`, the requests that a service
panel really makes then, and answers from ever after (`pick` says of which service, where the cell names
none), or of a fault lab the cases, and the tools to use in each; or `watch`, for how many seconds a panel
does what it otherwise does only while a page shows it.
`calls` are made meanwhile by the notebook's own node: a service's name, its type, the fields of the request.
"""

from __future__ import annotations

import copy
import json
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from course_pkg.authoring.cells import Cell, Notebook
from course_pkg.errors import CourseError

PLANS = Path(__file__).with_name("rehearsals.json")
MARK = "rehearsal"  # in the metadata of a cell that is no part of the notebook

Plan = Mapping[str, Any]


def plans(name: str) -> dict[str, Plan]:
    """Return what is done in the notebook called `name`, by cell."""
    every: dict[str, dict[str, Plan]] = json.loads(PLANS.read_text("utf-8"))
    return every.get(name, {})


def rehearsed(name: str, notebook: Notebook) -> Notebook:
    """Return `notebook` with a cell for each plan, below the cell that shows the panel."""
    planned = plans(name)
    cells: list[Cell] = []
    for cell in notebook["cells"]:
        cells.append(cell)
        if plan := planned.get(cell["id"]):
            cells.append(_added(cell, plan))
    return {**notebook, "cells": cells}


def without_rehearsal(notebook: Notebook) -> Notebook:
    """Return `notebook` without the cells that were added."""
    return {**notebook, "cells": [cell for cell in notebook["cells"] if MARK not in cell["metadata"]]}


def rehearse(panel: Any, plan: Plan) -> None:  # noqa: ANN401 -- a panel of whatever kind
    """Do what `plan` says, in the kernel of the notebook; where nobody answers, nothing is recorded."""
    if "pick" in plan:
        panel.received("pick", {"service": plan["pick"]})
    if "record" in plan:
        with suppress(CourseError):  # a student's notebook has no server yet where the solution has one
            panel.record(plan["record"])
    if "watch" in plan:
        panel.shown()
        _let_pass(plan["watch"], plan.get("calls", ()))
        panel.hidden()


def _let_pass(seconds: float, calls: Sequence[tuple[str, str, Mapping[str, Any]]]) -> None:
    """Let so much time pass, with calls at even distances."""
    from course_pkg.graph import this_node  # with rospy, which building a site does without

    for name, kind, fields in calls:
        time.sleep(seconds / (len(calls) + 1))
        if node := this_node():
            with suppress(CourseError):  # as above
                node.call(name, kind, **fields)
    time.sleep(seconds / (len(calls) + 1))


def _added(shown: Cell, plan: Plan) -> Cell:
    """Return a cell that leaves no name behind, for the panel that the cell above it showed.

    IPython keeps that among its results. `_` is no way to it: a notebook may have a variable of that name.
    """
    added = copy.deepcopy(shown)
    added["id"] = f"{MARK}-{shown['id']}"[:64]
    added["metadata"] = {MARK: True}
    added["source"] = (
        f'__import__("{__name__}", fromlist=["_"]).rehearse([*_oh.values()][-1], {dict(plan)!r})'
    )
    return added
