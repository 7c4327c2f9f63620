"""Tests of the service panel's widget on a real master, without a page."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from course_pkg.panels import GraphPanel, ServicePanel
from course_pkg.types import Plain
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("server")


@pytest.fixture
def panel() -> Iterator[ServicePanel]:
    """Yield a panel, and close the panel after the test."""
    panel = ServicePanel("/getGeometry")
    yield panel
    panel.close()


def threads() -> list[str]:
    """Return the names of the threads that panels have started."""
    return sorted(thread.name for thread in threading.enumerate() if thread.name.startswith("panel-"))


def ended(panel: ServicePanel) -> dict[str, Plain]:
    """Wait until the call has finished."""
    return eventually(lambda: panel.outcome if panel.outcome["phase"] not in ("idle", "running") else None)


def test_a_click_calls_the_real_server(panel: ServicePanel) -> None:
    """A click calls the real server, and the panel's state contains the response."""
    panel.received("call", {"draft": {"length": "1.2", "width": "5.2", "height": "8.9"}, "deadline": "5"})
    outcome = ended(panel)
    assert outcome["phase"] == "done"
    assert [(row["name"], float(row["text"])) for row in outcome["rows"]] == [
        ("area", pytest.approx(6.24, rel=1e-5)),
        ("volume", pytest.approx(55.54, rel=1e-3)),
    ]
    assert (
        panel.check["shell"] == "rosservice call /getGeometry 0.0 0.0 0.0"
    )  # The page sends the texts of the form in another message, which this test omits.


def test_a_cell_calls_with_the_same_form(panel: ServicePanel) -> None:
    """call() returns the response, and the form shows the request."""
    response = panel.call(length=2.0, width=3.0, height=4.0)
    assert (response.area, response.volume) == (6.0, 24.0)
    assert panel.response is response
    assert panel.draft == {"length": "2.0", "width": "3.0", "height": "4.0"}
    assert panel.check["shell"] == "rosservice call /getGeometry 2.0 3.0 4.0"


def test_the_text_of_a_panel_never_changes(panel: ServicePanel) -> None:
    """The panel's repr and plain text are the same before and after a call."""
    before = repr(panel)
    panel.call()
    assert repr(panel) == before == "ServicePanel('/getGeometry')"
    assert panel._repr_mimebundle_()[0]["text/plain"] == before
    assert repr(ServicePanel("getGeometry")) == before
    assert repr(ServicePanel()) == "ServicePanel()"
    assert repr(GraphPanel()) == "GraphPanel()"


def test_the_service_is_described(panel: ServicePanel) -> None:
    """The panel shows the type, the node and the fields of the service."""
    assert (panel.form["type"], panel.form["node"]) == ("course_pkg/geometry", "/SERVER_NODE")
    assert [field["name"] for field in panel.form["request"]["fields"]] == ["length", "width", "height"]
    assert {each["name"]: each["tool"] for each in panel.services}["/SERVER_NODE/get_loggers"] is True


def test_no_thread_without_a_page(panel: ServicePanel) -> None:
    """A thread reads the graph only while a page shows the panel."""
    assert threads() == []
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    panel._dispatch(panel, {"kind": "hello", "view": "b"}, [])
    assert threads() == ["panel-poller"]
    panel._dispatch(panel, {"kind": "bye", "view": "a"}, [])
    assert threads() == ["panel-poller"]
    panel._dispatch(panel, {"kind": "bye", "view": "b"}, [])
    eventually(lambda: not threads())
    panel._dispatch(panel, {"kind": "hello", "view": "c"}, [])
    panel.close()
    eventually(lambda: not threads())


def test_an_error_in_a_click_is_shown_in_the_panel(panel: ServicePanel) -> None:
    """If a message from the page is invalid, the panel shows the error."""
    panel._dispatch(panel, {"kind": "call"}, [])
    assert panel.notice == "KeyError: 'draft'"


def test_a_recording_holds_real_answers(panel: ServicePanel) -> None:
    """A recording contains the responses of a real server."""
    panel.record([{"length": 1.0, "width": 2.0, "height": 3.0}, {"length": -1.0}])
    assert [each["draft"]["length"] for each in panel.recording] == ["1.0", "-1.0"]
    assert panel.recording[0]["outcome"]["rows"][0]["text"] == "2.0"


@pytest.mark.parametrize("panel_class", [ServicePanel, GraphPanel])
def test_without_a_master_it_shows_the_reason(monkeypatch: pytest.MonkeyPatch, panel_class: type) -> None:
    """Without a master, the panel opens and shows the reason."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:9")
    panel = panel_class()
    assert "localhost:9" in panel.trouble
    panel.close()


def test_a_graph_panel_draws_the_real_graph() -> None:
    """In the graph panel, the drawing and the list contain the server and its service."""
    panel = GraphPanel(live=False)
    assert 'data-key="service /getGeometry"' in panel.drawing
    assert [fact["name"] for fact in panel.facts] == ["/SERVER_NODE", "/getGeometry"]
    panel._dispatch(panel, {"kind": "hello", "view": "a"}, [])
    assert threads() == []
    panel.close()
