"""What the site says of the course beside its notebooks fits the course as it is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.site.front import HERE
from course_pkg.site.rehearsal import PLANS, rehearsed, without_rehearsal

ROOT = Shelf().root
SYSTEMS = json.loads((HERE / "systems.json").read_text("utf-8"))


@pytest.mark.parametrize("name", json.loads(PLANS.read_text("utf-8")))
def test_a_rehearsal_is_of_a_panel(name: str) -> None:
    """Its cell is there, in the students' notebook as well, and it ends with a panel that can do that."""
    for folder in ("solutions", "notebooks"):
        cells = {cell["id"]: cell["source"] for cell in code_cells(read(ROOT / folder / f"{name}.ipynb"))}
        plans = json.loads(PLANS.read_text("utf-8"))[name]
        for cell, plan in plans.items():
            panels = ("ServicePanel(", "BreakIt(") if "record" in plan else ("TopicPanel(", "GraphPanel(")
            shown = cells[cell].rpartition("\n")[2]
            assert shown.startswith(panels)
            assert ("pick" in plan) == (shown == "ServicePanel()")


@pytest.mark.parametrize("path", Shelf().solutions(), ids=lambda path: path.stem)
def test_a_rehearsal_leaves_no_trace(path: Path) -> None:
    """The cells that are added for it are the only ones that go again."""
    notebook = read(path)
    assert without_rehearsal(rehearsed(path.stem, notebook)) == notebook


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda system: system["name"])
def test_a_system_can_be_started_as_it_says(system: dict[str, str]) -> None:
    """What its line names is in the package."""
    tool, package, name, *_ = system["start"].split()
    folder = {"course_pkg": ROOT / "course_pkg" / "nodes", "turtlesim": ROOT / "course_pkg" / "turtlesim"}[
        package
    ]
    assert (ROOT / "launch" / name if tool == "roslaunch" else folder / f"{name}.py").exists()
