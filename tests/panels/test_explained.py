"""Below an error of its own, every panel offers what it means."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import course_pkg.panels
from course_pkg.errors import GraphError
from course_pkg.faults import caused
from course_pkg.graph import PrivateMaster
from course_pkg.panels import GraphPanel, ServicePanel, TypeBrowser, WireView
from course_pkg.panels.assets import module
from course_pkg.panels.panel import Panel

PANELS = Path(course_pkg.panels.__file__).parent
ENTRIES = sorted(path for path in PANELS.glob("*/*.js") if "export default" in path.read_text())


@pytest.fixture(autouse=True)
def nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody is where the master should be."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")


@pytest.mark.parametrize("kind", [GraphPanel, ServicePanel, TypeBrowser], ids=lambda kind: kind.__name__)
def test_a_graph_that_cannot_be_seen_is_explained(kind: type[Panel]) -> None:
    """Cause, remedy and chapter stand beside the words of the error."""
    panel = kind()
    assert "No ROS master" in panel.trouble
    assert panel.explained["cause"].startswith("No master answers")
    assert panel.explained["remedy"]
    assert panel.explained["taught"].startswith("chapter 10")
    panel.close()


def test_an_error_of_a_panel_itself_is_explained_if_it_is_known() -> None:
    """It comes before the graph's, and goes with it; an unknown one gets no guess."""
    panel = TypeBrowser()
    panel.complain(GraphError("ServiceException: service [/x] unavailable"))
    assert "knows no provider" in panel.explained["cause"]
    panel.complain(KeyError("sprocket"))
    assert panel.explained == {}
    panel.publish(notice="", trouble="")
    assert panel.explained == {}
    panel.close()


def test_the_error_of_a_call_that_was_taken_down_is_explained(master: PrivateMaster) -> None:
    """The wire view shows how a call failed, and offers what that means."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_MASTER_URI", master.uri)
        with caused("returns_none"):
            view = WireView("/lab/door", data=True)
    assert "service handler returned None" in view.exchange["outcome"]
    assert "reached its end without a return" in view.explained["cause"]
    view.close()


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda path: path.stem)
def test_each_panel_is_framed(entry: Path) -> None:
    """What each draws goes through the frame, and the joined text declares no name twice."""
    joined = module(entry, PANELS / "explained.js")
    assert joined.count("export default { render: framed(render) };") == 1
    assert joined.count("export ") == 1
    declared = re.findall(r"^(?:async )?(?:function|const|let|class) (\w+)", joined, re.MULTILINE)
    assert len(declared) == len(set(declared))
