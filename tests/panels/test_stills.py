"""Tests of the SVG picture of each panel."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest

from course_pkg.panels import paper
from course_pkg.panels.breakit.cases import CaseStore
from course_pkg.panels.breakit.view import BreakIt
from course_pkg.panels.choices.view import choose
from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.layout import laid_out
from course_pkg.panels.graph.picture import Kind, Line, Picture, Shape
from course_pkg.panels.paper import CODE, PLAIN, Paper, State, wrapped
from course_pkg.panels.prediction.view import Predictions, Question
from course_pkg.panels.stills import STILLS
from course_pkg.panels.timeline.model import state as timeline_state
from course_pkg.ros.trace.recording import HANDLER, REQUEST, RESPONSE, WAIT, Event, Recording
from course_pkg.types import message_type, schema

PANELS = Path(paper.__file__).parent
SVG = "{http://www.w3.org/2000/svg}"
UNSAFE = re.compile(r"<script|foreignObject|href|url\(|<style| id=|<image|light-dark|var\(")


def graph_state() -> State:
    """Return the state of a graph panel with a node, a topic and a service."""
    shapes = (
        Shape(Kind.NODE, "/camera"),
        Shape(Kind.NODE, "/rostopic_123_1700000000000", reachable=False),
        Shape(Kind.SERVICE, "/camera/set"),
        Shape(Kind.TOPIC, "/pictures"),
    )
    lines = (
        Line("node /camera", "service /camera/set", both=True),
        Line("node /camera", "topic /pictures"),
        Line("topic /pictures", "node /rostopic_123_1700000000000"),
    )
    words = "2 nodes, 1 topic, 1 service. The list after the drawing contains the same information as text."
    facts = [
        {"key": each.key, "kind": each.kind.value, "name": each.name, "lost": not each.reachable, "facts": []}
        for each in shapes
    ]
    return {"drawing": svg(laid_out(Picture(shapes, lines)), description=words), "facts": facts}


def service_state() -> State:
    """Return the state of a service panel after a call."""
    request = schema(message_type("geometry_msgs/Pose"))
    form = {"service": "/go", "node": "/robot", "problem": "", "type": "my/Go", "request": request}
    rows = [{"depth": 0, "name": "success", "type": "bool", "text": "true"}]
    outcome = {"phase": "done", "ms": 3.5, "at": "12:00:01", "rows": rows}
    return {"form": form, "draft": {}, "outcome": outcome, "check": {"shell": "rosservice call /go '<&>'"}}


def topic_state() -> State:
    """Return the state of a topic panel with a known type."""
    message = schema(message_type("std_msgs/Float64"))
    about = {
        "topic": "/speed",
        "problem": "",
        "burst": 1000,
        "message": message,
        "listen": ["rostopic hz /speed"],
    }
    peers = {"publishers": [{"node": "/robot", "type": "std_msgs/Float64"}], "subscribers": []}
    settings = {"rate": "10", "queue": "10", "latch": False, "path": "data"}
    return {"about": about, "connections": peers, "settings": settings, "draft": {"data": "0.0"}}


def types_state() -> State:
    """Return the state of a type browser with an open type."""
    fields = [{"name": "data", "type": "bool", "help": "on or off", "fields": []}]
    parts = [
        {"title": "Request", "help": "", "fields": fields, "constants": []},
        {"title": "Response", "help": "", "fields": [], "constants": []},
    ]
    lines = [{"label": "import, in Python", "text": "from std_srvs.srv import SetBool"}]
    described = {"name": "std_srvs/SetBool", "half": "srv", "parts": parts, "md5": "09fb", "lines": lines}
    described |= {"problem": "", "warning": "", "file": "/opt/SetBool.srv", "text": "bool data\n---\n"}
    return {"described": described, "offers": {"srv": {}, "msg": {}}, "packages": []}


def wire_state() -> State:
    """Return the state of a wire view of a failed call. The port of the server is random."""
    piece = {
        "role": "ok",
        "at": 0,
        "size": 1,
        "depth": 0,
        "name": "ok",
        "type": "uint8",
        "value": "0",
        "hex": "00",
    }
    step = {"says": "", "size": 0, "pieces": [], "text": "", "bad": False, "connection": 0, "ms": 0.25}
    steps = [
        {**step, "title": "The service is at rosrpc://localhost:40123", "from": "master", "to": "client"},
        {
            **step,
            "title": "Error",
            "from": "server",
            "to": "client",
            "size": 1,
            "pieces": [piece],
            "bad": True,
        },
    ]
    names = {"client": "/a", "server": "/b", "master": "master"}
    return {"exchange": {"service": "/s", "names": names, "steps": steps, "outcome": "no", "notes": []}}


def timeline() -> State:
    """Return the state of a timeline of one call."""
    parts = (
        Event(REQUEST, "/a", "/s", 0.0, 0.001, "/b", "k", "main"),
        Event(WAIT, "/a", "/s", 0.001, 0.2, "/b", "k", "main"),
        Event(HANDLER, "/b", "/s", 0.01, 0.19, "/a", "k", "worker"),
        Event(RESPONSE, "/a", "/s", 0.2, 0.2, "/b", "k", "main"),
    )
    return {"recorded": timeline_state(Recording(events=parts, length=0.3))}


def turtles_state() -> State:
    """Return the state of a turtle panel after the simulator has ended."""
    rows = [
        [0, 0, 5544, 5544, 0, -1],
        [50, 0, 6000, 5544, 0, 0],
        [90, 0, 6500, 5544, 785, 0],
        [99, 0, "gone"],
    ]
    recorded = {"background": [69, 86, 255], "names": ["turtle1"], "palette": [[179, 184, 255]], "rows": rows}
    return {"recorded": {**recorded, "length": 99, "edition": 0}}


def question() -> State:
    """Return the state of a prediction without an answer."""
    return _traits(Question("05.x", "Is 1 < 2 & `x` true? " * 9, ["yes", "no", "it depends on " * 9]))


STATES: dict[str, tuple[str, Callable[[], State]]] = {
    "breakit": ("breakit", lambda: _traits(BreakIt("serving", store=CaseStore()))),
    "choices": ("choices", lambda: _traits(choose("03.cases"))),
    "graph": ("graph", graph_state),
    "an empty graph": ("graph", lambda: {"drawing": "", "facts": [], "trouble": "There is no master."}),
    "question": ("prediction", question),
    "comparison": ("prediction", lambda: _traits(Question("05.y", "?").compare("an error"))),
    "table": ("prediction", lambda: _traits(Predictions("05"))),
    "service": ("service", service_state),
    "no service": ("service", lambda: {"form": {}, "services": [], "trouble": ""}),
    "timeline": ("timeline", timeline),
    "topic": ("topic", topic_state),
    "turtles": ("turtles", turtles_state),
    "types": ("types", types_state),
    "wire": ("wire", wire_state),
}


def _traits(panel: object) -> State:
    """Return the panel's traits that the page receives, and close the panel."""
    state: State = panel.get_state()  # type: ignore[attr-defined]
    panel.close()  # type: ignore[attr-defined]
    return state


@pytest.fixture(autouse=True)
def _own_records(tmp_path: object, monkeypatch: pytest.MonkeyPatch) -> None:
    """Select an empty state folder for each test."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))


def test_each_kind_of_panel_has_a_picture() -> None:
    """The dicts STILLS and STATES contain each kind of panel."""
    folders = {path.parent.name for path in PANELS.glob("*/view.py")}
    assert set(STILLS) == folders == {panel for panel, _ in STATES.values()}


@pytest.mark.parametrize("name", STATES)
def test_a_picture_is_complete(name: str) -> None:
    """The picture is a well-formed SVG with a title and a background, and is the same each time."""
    panel, state = STATES[name]
    given = state()
    first = STILLS[panel].draw(given)
    assert STILLS[panel].draw(given) == first
    root = fromstring(first)  # noqa: S314 - it is our own
    assert root.tag == f"{SVG}svg"
    assert root[0].tag == f"{SVG}title"
    assert root[0].text
    ground = next(root.iter(f"{SVG}rect"))
    assert ground.get("fill") == "#ffffff"
    width, height = float(root.get("width", "0")), float(root.get("height", "0"))
    assert float(ground.get("width", "0")) == pytest.approx(width, abs=2)
    assert float(ground.get("height", "0")) == pytest.approx(height, abs=2)
    assert not UNSAFE.search(first)
    for text in root.iter(f"{SVG}text"):
        if "." in text.get("y", "") and text.get("text-anchor") is None:
            assert float(text.get("x", "0")) < width


def test_values_that_differ_in_each_run_are_left_out() -> None:
    """Pictures contain no port, time of day or process id; only two kinds of pictures show measured times."""
    graph = STILLS["graph"].draw(graph_state())
    assert "1700000000000" not in graph
    assert "1 topic" in graph
    assert "40123" not in STILLS["wire"].draw(wire_state())
    service = STILLS["service"].draw(service_state())
    assert "12:00" not in service
    assert "3.5" not in service
    assert {name for name, still in STILLS.items() if still.measured} == {"timeline", "turtles"}


def test_turtles_are_shown_even_if_the_simulator_has_ended() -> None:
    """After the simulator has ended, the picture still shows the turtles at their last positions."""
    drawn = STILLS["turtles"].draw(turtles_state())
    assert ">turtle1</text>" in drawn
    assert "<polyline" in drawn


def test_a_timeline_shows_bars_arrows_and_sentences() -> None:
    """The picture of a call has a bar for the caller, a bar for the server, and two arrows."""
    drawn = STILLS["timeline"].draw(timeline())
    assert "waits for /b" in drawn
    assert drawn.count("<polygon") == 2
    assert "/a called /s and waited for /b." in drawn


def test_lines_fit_and_keep_every_word() -> None:
    """Text is wrapped between words, and a very long word is split."""
    text = "a word " * 30 + "x" * 200
    lines = wrapped(text, PLAIN, 200)
    assert all(PLAIN.width(line) <= 200 for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert wrapped("    indented", CODE, 200) == ["\N{NO-BREAK SPACE}" * 4 + "indented"]


def test_text_from_outside_stays_text() -> None:
    """Markup and invalid XML characters in a text do not damage the picture."""
    written = Paper("<b>&\x00")
    written.write("<script>\x1b[31m")
    root = fromstring(written.svg())  # noqa: S314 - it is our own
    assert [each.text for each in root.iter(f"{SVG}text")] == ["<script>\N{REPLACEMENT CHARACTER}[31m"]
