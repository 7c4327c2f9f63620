"""The graph panel's widget on a real master, with no page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from course_pkg.graph import NodeProcess, NodeSeen, PrivateMaster, Snapshot
from course_pkg.panels.graph import view
from course_pkg.panels.graph.view import GraphPanel
from tests.kernel import Kernel
from tests.support import eventually, stopped


@pytest.fixture(scope="module")
def pulse(master: PrivateMaster) -> Iterator[NodeProcess]:
    """The course's pulse, running: it publishes twice a second."""
    assert master.uri
    with NodeProcess.rosrun("course_pkg", "pulse") as process:
        process.wait_for_service("/pulse/get_loggers", timeout=20)
        yield process


@pytest.fixture
def panel(pulse: NodeProcess) -> Iterator[GraphPanel]:
    """A panel that looks at the pulse."""
    assert pulse.running
    panel = GraphPanel()
    yield panel
    panel.close()


def test_the_repr_is_stable(panel: GraphPanel) -> None:
    """Whatever is on the graph, the text of the output is the same."""
    assert repr(panel) == "GraphPanel()"


def test_a_rate_comes_by_itself_while_a_page_shows_the_panel(panel: GraphPanel, kernel: Kernel) -> None:
    """Somebody who listens is connected, counted, and told with a rate; a hidden panel asks nobody."""
    kernel.run(
        "from course_pkg.graph import join\nnode = join('ear')\nnode.subscribe('/pulse', 'std_msgs/UInt32')"
    )
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    eventually(lambda: panel.activity["notes"].get("topic /pulse") == "2 Hz", timeout=30)
    panel._dispatch(panel, {"kind": "bye", "view": "a"}, [])
    assert panel._listener._stop is None


def test_what_was_shown_is_handed_over_once_when_no_page_shows_it(panel: GraphPanel) -> None:
    """While a page shows it, nothing grows; hidden, it has the pictures of that time; shown again, none."""
    told: list[object] = []
    panel.observe(lambda change: told.append(change["new"]), "history")
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    panel._model.choose(noise=True, show_own=True)
    panel._dispatch(panel, {"kind": "hello", "view": "b"}, [])
    panel._model.choose(noise=False, show_own=True)
    panel._dispatch(panel, {"kind": "bye", "view": "a"}, [])
    assert told == []
    panel._dispatch(panel, {"kind": "bye", "view": "b"}, [])
    assert told == [panel.history]
    drawings = [panel.history["scenes"][scene]["drawing"] for _, scene, _ in panel.history["moments"]]
    assert any("/pulse/get_loggers" in drawing for drawing in drawings)
    assert "/pulse/get_loggers" not in drawings[-1]
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    assert panel.history == {}


def test_a_panel_that_stays_as_it_is_keeps_nothing(pulse: NodeProcess) -> None:
    """With live=False there is one picture."""
    assert pulse.running
    panel = GraphPanel(live=False)
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    panel._model.choose(noise=True, show_own=True)
    panel.close()
    assert panel.history == {}


def test_a_click_folds_a_namespace(panel: GraphPanel) -> None:
    """With the loggers shown, those of a node are a namespace that a click folds."""
    panel.received("choose", {"noise": True, "show_own": True})
    panel.received("fold", {"name": "/pulse/", "fold": True})
    assert {"name": "/pulse/", "folded": True} in panel.spaces
    assert 'data-key="namespace /pulse/"' in panel.drawing
    assert "namespace /pulse/" in panel.svg()


def test_the_kernel_s_own_node_is_found(kernel: Kernel) -> None:
    """After join() the panel offers to hide this notebook's node; before, there is none."""
    own = "from course_pkg import GraphPanel, join\nfrom course_pkg.graph import this_node\n"
    assert kernel.run(own + "result = [this_node(), GraphPanel().own]") == [None, ""]
    joined = (
        "node = join('mine')\nresult = [this_node() is node, GraphPanel().own, GraphPanel(node=node).own]"
    )
    assert kernel.run(joined) == [True, "/mine", "/mine"]


def test_a_node_that_is_late_once_is_not_lost(
    panel: GraphPanel, pulse: NodeProcess, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine a node may miss one look: it is asked again before it is said to be gone."""
    seen = panel._model.snapshot
    assert seen is not None
    late = Snapshot(seen.master, tuple(replace(each, reach="silent") for each in seen.nodes), (), ())
    looks = [late, seen]
    monkeypatch.setattr(view, "look", lambda: looks.pop(0))
    assert panel._look() is seen
    monkeypatch.undo()
    with stopped(pulse.pid):
        node = panel._look().node("/pulse")
    assert isinstance(node, NodeSeen)
    assert not node.reachable
