"""Tests of the graph panel's model."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from course_pkg.errors import DrawingFailed
from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.layout import LONGEST, Layout, laid_out
from course_pkg.panels.graph.model import GraphModel
from course_pkg.panels.graph.picture import Kind, Line, graph_text, picture
from course_pkg.ros import Snapshot
from course_pkg.ros.protocol.snapshot import NodeSeen, ServiceSeen, TopicSeen
from course_pkg.types import Plain

SVG = "{http://www.w3.org/2000/svg}"


def snapshot(
    *, topics: tuple[TopicSeen, ...] = (), services: tuple[ServiceSeen, ...] = (), dead: str = ""
) -> Snapshot:
    """Return a snapshot of topics and services, with the nodes that publish, subscribe or serve them."""
    names = {name for topic in topics for name in (*topic.publishers, *topic.subscribers)}
    names |= {service.node for service in services}
    nodes = tuple(
        NodeSeen(name, f"http://localhost:1{name}", "refused" if name == dead else "answered")
        for name in sorted(names)
    )
    return Snapshot("http://localhost:11311", nodes, topics, services)


CHATTER = TopicSeen("/chatter", "std_msgs/String", ("/talker",), ("/listener",))
ROSOUT = TopicSeen("/rosout", "rosgraph_msgs/Log", ("/listener", "/talker"), ("/rosout",))
GEOMETRY = ServiceSeen("/getGeometry", "course_pkg/geometry", "/server", "rosrpc://localhost:1", "answered")
LOGGERS = ServiceSeen(
    "/server/get_loggers", "roscpp/GetLoggers", "/server", "rosrpc://localhost:1", "answered"
)
WHOLE = snapshot(topics=(CHATTER, ROSOUT), services=(GEOMETRY, LOGGERS), dead="/listener")


def test_lines_have_the_direction_of_the_data() -> None:
    """Lines lead from the publisher to the topic, and from the topic to the subscriber."""
    assert set(picture(WHOLE).lines) == {
        Line("node /talker", "topic /chatter"),
        Line("topic /chatter", "node /listener"),
        Line("node /server", "service /getGeometry", both=True),
    }


def test_rosout_and_loggers_are_hidden_by_default() -> None:
    """By default, /rosout and the logger services are hidden."""
    assert {shape.name for shape in picture(WHOLE).shapes} == {
        "/talker",
        "/listener",
        "/server",
        "/chatter",
        "/getGeometry",
    }
    assert {"/rosout", "/server/get_loggers"} <= {shape.name for shape in picture(WHOLE, noise=True).shapes}


def test_a_hidden_node_hides_its_services_and_its_own_topics() -> None:
    """The services and topics of a hidden node are hidden."""
    shown = picture(WHOLE, hide=["/server", "/talker"])
    assert {shape.name for shape in shown.shapes} == {"/listener", "/chatter"}
    assert shown.lines == (Line("topic /chatter", "node /listener"),)


def test_the_order_of_the_snapshot_does_not_matter() -> None:
    """The order of a snapshot's entries does not change the drawing."""
    turned = Snapshot(WHOLE.master, WHOLE.nodes[::-1], WHOLE.topics[::-1], WHOLE.services[::-1])
    assert picture(turned) == picture(WHOLE)


def test_the_graph_as_text_contains_no_port() -> None:
    """The plain text lists the topics and services of each node, and is the same in every run."""
    assert graph_text(WHOLE) == (
        "/listener\n  subscribes /chatter  (std_msgs/String)\n"
        "/server\n  serves     /getGeometry  (course_pkg/geometry)\n"
        "/talker\n  publishes  /chatter  (std_msgs/String)"
    )
    assert graph_text(snapshot()) == "no nodes"


def test_shapes_do_not_overlap_and_lie_inside() -> None:
    """The elements of a drawing do not overlap."""
    layout = laid_out(picture(WHOLE, noise=True))
    boxes = []
    for placed in layout.shapes:
        (x, y), wide, high = placed.centre, placed.width / 2, placed.height / 2
        boxes.append((x - wide, x + wide, y - high, y + high))
        assert x - wide >= -1
        assert x + wide <= layout.width + 1
        assert y - high >= -1
        assert y + high <= layout.height + 1
    for number, (left, right, top, bottom) in enumerate(boxes):
        for other in boxes[:number]:
            assert right <= other[0] or other[1] <= left or bottom <= other[2] or other[3] <= top
    assert len(layout.lines) == len(picture(WHOLE, noise=True).lines)


def test_a_long_name_is_shortened_in_the_drawing_only() -> None:
    """In the drawing, the middle of a long name is left out."""
    name = "/robot/" + "x" * 60 + "/pose"
    shown = picture(snapshot(topics=(TopicSeen(name, "a/B", ("/n",), ()),)))
    placed = next(each for each in laid_out(shown).shapes if each.shape.kind is Kind.TOPIC)
    assert len(placed.label) <= LONGEST
    assert placed.label.endswith("/pose")
    assert f"topic {name}" in svg(laid_out(shown))


def test_each_shape_has_an_accessible_name() -> None:
    """Each element is a button with an accessible name."""
    root = ElementTree.fromstring(svg(laid_out(picture(WHOLE)), description="five shapes"))  # noqa: S314 - it is our own
    buttons = {group.get("aria-label") for group in root.iter(f"{SVG}g") if group.get("role") == "button"}
    assert buttons == {
        "node /listener, does not answer",
        "node /server",
        "node /talker",
        "service /getGeometry",
        "topic /chatter",
    }
    assert root.findtext(f"{SVG}desc") == "five shapes"
    assert (
        len(root.findall(f".//{SVG}polygon")) == 2 + 2 + 1
    )  # The topic has two arrowheads, the service has two arrowheads, and the service is drawn as a polygon.


def test_a_name_cannot_bring_markup_into_the_page() -> None:
    """HTML in the name of a node is shown as text."""
    evil = '/<script>alert("x")</script>'
    drawn = svg(laid_out(picture(snapshot(topics=(TopicSeen(evil, "a/B", ("/n",), ()),)))))
    assert "<script" not in drawn
    assert ElementTree.fromstring(drawn) is not None  # noqa: S314 - it is our own


class Wall:
    """A model, and the list of the messages that the model sends."""

    def __init__(self, **options: str) -> None:
        self.said: list[dict[str, Plain]] = []
        self.model = GraphModel(lambda **parts: self.said.append(parts), **options)


def test_a_graph_that_looks_the_same_is_not_drawn_again() -> None:
    """If only a hidden node changes, the panel does not draw the graph again."""
    wall = Wall()
    wall.model.see(WHOLE)
    more = ServiceSeen("/server/set_logger_level", "roscpp/SetLoggerLevel", "/server", "x", "answered")
    wall.model.see(Snapshot(WHOLE.master, WHOLE.nodes, WHOLE.topics, (*WHOLE.services, more)))
    assert len(wall.said) == 1


def test_a_choice_draws_again() -> None:
    """If the student shows the hidden names, the panel draws the graph again."""
    wall = Wall(own="/server")
    wall.model.see(WHOLE)
    wall.model.choose(noise=True, show_own=False)
    assert "/rosout" in wall.said[-1]["drawing"]
    assert "/getGeometry" not in wall.said[-1]["drawing"]


def test_without_graphviz_the_list_is_shown(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Without Graphviz, the panel shows an installation command and a list of the graph."""
    monkeypatch.setenv("PATH", str(tmp_path))
    wall = Wall()
    wall.model.see(WHOLE)
    assert wall.said[-1]["drawing"] == ""
    assert "apt install graphviz" in wall.said[-1]["trouble"]
    assert {key: value for key, value in wall.said[-1]["facts"][-1].items() if key != "facts"} == {
        "key": "topic /chatter",
        "kind": "topic",
        "name": "/chatter",
        "lost": False,
    }


@pytest.mark.parametrize(
    ("script", "stretch"), [("exec sleep 60", "took longer"), ("echo bad >&2; exit 3", "failed")]
)
def test_graphviz_has_a_deadline(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, script: str, stretch: str
) -> None:
    """If Graphviz fails or does not finish, the panel shows one error message."""
    dot = tmp_path / "dot"
    dot.write_text(f"#!/bin/sh\n{script}\n")
    dot.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    with pytest.raises(DrawingFailed, match=stretch):
        laid_out(picture(WHOLE), timeout=0.2)


def test_a_graph_that_cannot_be_read_keeps_the_old_picture() -> None:
    """Without a master, the panel shows the reason, and the old drawing does not change."""
    wall = Wall()
    wall.model.see(WHOLE)
    wall.model.lose("No master answers.")
    assert wall.said[-1] == {"trouble": "No master answers."}
    wall.model.see(WHOLE)
    assert wall.said[-1]["trouble"] == ""


def test_an_empty_graph_needs_no_graphviz(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """An empty graph causes no error without Graphviz."""
    monkeypatch.setenv("PATH", str(tmp_path))
    assert laid_out(picture(snapshot())) == Layout()
