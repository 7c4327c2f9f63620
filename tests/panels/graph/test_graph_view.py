"""Tests of the graph panel: its widget with a real master, and its recording."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace

import pytest

from course_pkg.panels.graph import view
from course_pkg.panels.graph.activity import ActivityState
from course_pkg.panels.graph.history import BYTES, MOMENTS, History
from course_pkg.panels.graph.model import Scene
from course_pkg.panels.graph.view import GraphPanel
from course_pkg.ros import NodeProcess, NodeSeen, PrivateMaster, Snapshot
from tests.kernel import Kernel
from tests.support import eventually, stopped

BEGAN = 1_800_000_000.0  # s since the epoch


def shown(drawing: str = "<svg/>", **notes: str) -> tuple[Scene, ActivityState]:
    """Return one state of the graph panel; `notes` are the texts below the names of the topics."""
    return {"drawing": drawing, "facts": [], "spaces": [], "trouble": ""}, {"notes": notes}


def filled(*states: tuple[Scene, ActivityState]) -> History:
    """Return a recording that contains one state for each second."""
    history = History()
    history.start(BEGAN, *states[0])
    for number, state in enumerate(states[1:], start=1):
        history.add(BEGAN + number, *state)
    return history


@pytest.fixture(scope="module")
def pulse(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the course's node pulse, which publishes twice per second."""
    assert master.uri
    with NodeProcess.rosrun("course_pkg", "pulse") as process:
        process.wait_for_service("/pulse/get_loggers", timeout=20)
        yield process


@pytest.fixture
def panel(pulse: NodeProcess) -> Iterator[GraphPanel]:
    """Open a panel that shows the node pulse."""
    assert pulse.running
    panel = GraphPanel()
    yield panel
    panel.close()


def test_the_repr_is_stable(panel: GraphPanel) -> None:
    """The plain text of the panel is the same for every graph."""
    assert repr(panel) == "GraphPanel()"


def test_a_rate_appears_while_a_page_shows_the_panel(panel: GraphPanel, kernel: Kernel) -> None:
    """A visible panel reads the message counts and shows a topic's rate; a hidden panel reads no counts."""
    kernel.run("from course_pkg.ros import join\nnode = join('listener')")
    kernel.run("node.subscribe('/pulse', 'std_msgs/UInt32')")
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    eventually(lambda: panel.activity["notes"].get("topic /pulse") == "2 Hz", timeout=30)
    panel._dispatch(panel, {"kind": "bye", "view": "a"}, [])
    assert panel._counts._stop is None


def test_the_recording_is_sent_once_when_no_page_shows_the_panel(panel: GraphPanel) -> None:
    """When the page is closed, the panel sends its recording once."""
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


def test_a_panel_that_is_not_live_records_nothing(pulse: NodeProcess) -> None:
    """With live=False, the panel shows one drawing and records nothing."""
    assert pulse.running
    panel = GraphPanel(live=False)
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    panel._model.choose(noise=True, show_own=True)
    panel.close()
    assert panel.history == {}


def test_a_click_folds_a_namespace(panel: GraphPanel) -> None:
    """A click on a namespace folds the namespace."""
    panel.received("choose", {"noise": True, "show_own": True})
    panel.received("fold", {"name": "/pulse/", "fold": True})
    assert {"name": "/pulse/", "folded": True} in panel.spaces
    assert 'data-key="namespace /pulse/"' in panel.drawing
    assert "namespace /pulse/" in panel.svg()


def test_the_kernel_s_own_node_is_found(kernel: Kernel) -> None:
    """After join(), the panel has an option to hide the notebook's node."""
    own = "from course_pkg import GraphPanel, join\nfrom course_pkg.ros import this_node\n"
    assert kernel.run(own + "result = [this_node(), GraphPanel().own]") == [None, ""]
    joined = (
        "node = join('mine')\nresult = [this_node() is node, GraphPanel().own, GraphPanel(node=node).own]"
    )
    assert kernel.run(joined) == [True, "/mine", "/mine"]


def test_a_node_that_is_late_once_is_not_lost(
    panel: GraphPanel, pulse: NodeProcess, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The panel reports a node as silent only if the node does not respond to two requests in succession."""
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


def test_an_unchanged_graph_has_no_recording() -> None:
    """If the graph does not change, the recording is empty."""
    assert filled(*[shown()] * 5).state(BEGAN + 9) == {}


def test_moments_and_their_scenes() -> None:
    """If a drawing is shown several times, the recording contains this drawing once."""
    kept = filled(shown("a"), shown("a", x="2 Hz"), shown("b"), shown("a"))
    state = kept.state(BEGAN + 8.5)
    assert state["began"] == BEGAN
    assert state["length"] == 8500
    assert [scene["drawing"] for scene in state["scenes"]] == ["a", "b"]
    assert [moment[:2] for moment in state["moments"]] == [(0, 0), (1000, 0), (2000, 1), (3000, 0)]
    assert state["moments"][1][2] == {"notes": {"x": "2 Hz"}}


def test_moments_stay_in_order_if_the_clock_is_set_back() -> None:
    """If the clock is set back, the entries of a recording are still in the order of their times."""
    history = filled(shown("a"), shown("b"))
    history.add(BEGAN - 3600, *shown("c"))
    assert [moment[0] for moment in history.state(BEGAN - 3600)["moments"]] == [0, 1000, 1000]


def test_nothing_is_recorded_before_the_start_and_after_the_end() -> None:
    """A new start of the recording deletes the previous recording."""
    history = History()
    history.add(BEGAN, *shown("a"))
    history.start(BEGAN, *shown("b"))
    history.add(BEGAN + 1, *shown("c"))
    history.stop()
    history.add(BEGAN + 2, *shown("d"))
    assert [scene["drawing"] for scene in history.state(BEGAN + 2)["scenes"]] == ["b", "c"]
    history.start(BEGAN + 3, *shown("e"))
    assert history.state(BEGAN + 4) == {}


def test_the_number_of_moments_is_limited() -> None:
    """The recording contains only the newest entries."""
    kept = filled(*(shown("a", turn=str(turn)) for turn in range(3 * MOMENTS)))
    moments = kept.state(BEGAN + 3 * MOMENTS)["moments"]
    assert len(moments) == MOMENTS
    assert (moments[0][0], moments[-1][2]) == (0, {"notes": {"turn": str(3 * MOMENTS - 1)}})


def test_the_size_of_a_recording_is_limited() -> None:
    """If all drawings together are larger than the limit, the recording removes the oldest drawings."""
    kept = filled(*(shown(f"{turn:020000}") for turn in range(40)))
    state = kept.state(BEGAN + 40)
    assert len(json.dumps(state)) < 1.1 * BYTES
    assert state["scenes"][-1]["drawing"] == f"{39:020000}"
    assert len(state["scenes"]) == len(state["moments"]) > 5


def test_a_drawing_that_is_too_large_is_not_played() -> None:
    """A drawing that is larger than the limit is not stored, and causes no error."""
    assert filled(shown("a"), shown("x" * (BYTES + 1)), shown("y" * (BYTES + 1))).state(BEGAN + 3) == {}
