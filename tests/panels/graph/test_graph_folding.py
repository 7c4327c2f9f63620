"""Tests of framed and folded namespaces in the graph."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.layout import WIDE, laid_out
from course_pkg.panels.graph.model import GraphModel
from course_pkg.panels.graph.picture import (
    CROWD,
    Kind,
    Line,
    Picture,
    folded,
    namespaces,
    picture,
    space,
)
from course_pkg.ros import NodeSeen, ServiceSeen, Snapshot, TopicSeen

SVG = "{http://www.w3.org/2000/svg}"


def graph(*topics: tuple[str, str, str], services: dict[str, str] | None = None) -> Snapshot:
    """Return a snapshot with services and topics; a topic is a tuple (publisher, name, subscriber)."""
    offered = services or {}
    names = sorted({name for who, _, whom in topics for name in (who, whom)} | set(offered.values()))
    return Snapshot(
        "http://localhost:11311",
        tuple(NodeSeen(name, "http://localhost:1/", "answered") for name in names),
        tuple(TopicSeen(topic, "a/B", (who,), (whom,)) for who, topic, whom in topics),
        tuple(ServiceSeen(name, "a/C", node, "rosrpc://x:1", "answered") for name, node in offered.items()),
    )


TURTLE = graph(
    ("/sim", "/turtle1/pose", "/monitor"),
    ("/teleop", "/turtle1/cmd_vel", "/sim"),
    services={"/turtle1/set_pen": "/sim", "/clear": "/sim"},
)
NESTED = graph(
    ("/robot/base/driver", "/robot/base/odom", "/robot/planner"),
    ("/robot/planner", "/robot/goal", "/screen"),
    ("/screen", "/robot/arm/command", "/robot/arm/driver"),
)


def many(count: int) -> Snapshot:
    """Return a snapshot of several turtles with three topics each."""
    kinds = ("pose", "color", "scan")
    return graph(*(("/sim", f"/turtle{n}/{kind}", "/watch") for n in range(count) for kind in kinds))


def names(shown: Picture) -> set[str]:
    """Return the names of the visible elements."""
    return {each.name for each in shown.shapes}


def test_a_namespace_has_two_or_more_shapes() -> None:
    """A prefix is a namespace only if the names of at least two nodes, topics or services begin with it."""
    assert set(namespaces(picture(TURTLE))) == {"/turtle1/"}
    lonely = graph(("/a", "/far/away/one", "/b"), ("/a", "/far/away/two", "/b"), ("/a", "/x/y", "/b"))
    assert set(namespaces(picture(lonely))) == {"/far/away/"}
    assert set(namespaces(picture(NESTED))) == {"/robot/", "/robot/base/", "/robot/arm/"}


def test_a_small_graph_is_framed_and_not_folded() -> None:
    """In a small graph, each namespace is drawn with a frame and is not folded."""
    shown = folded(picture(TURTLE), {})
    assert names(shown) == names(picture(TURTLE))
    assert {frame.name: len(frame.members) for frame in shown.frames} == {"/turtle1/": 3}


def test_a_folded_namespace_is_one_box_with_all_lines() -> None:
    """A folded namespace is one box, and all lines of its elements lead to the box."""
    shown = folded(picture(TURTLE), {"/turtle1/": True})
    assert names(shown) == {"/sim", "/monitor", "/teleop", "/clear", "/turtle1/"}
    box = "namespace /turtle1/"
    assert set(shown.lines) == {
        Line("node /sim", box),
        Line(box, "node /monitor"),
        Line("node /teleop", box),
        Line(box, "node /sim"),
        Line("node /sim", box, both=True),
        Line("node /sim", "service /clear", both=True),
    }
    assert dict(next(each for each in shown.shapes if each.kind is Kind.SPACE).facts) == {
        "holds": "2 topics, 1 service",
        "services": "/turtle1/set_pen",
    }


def test_lines_inside_a_box_are_not_drawn() -> None:
    """If a line connects two elements of the same folded namespace, the line is not drawn."""
    shown = folded(picture(NESTED), {"/robot/": True})
    assert names(shown) == {"/screen", "/robot/"}
    assert set(shown.lines) == {
        Line("namespace /robot/", "node /screen"),
        Line("node /screen", "namespace /robot/"),
    }


def test_a_box_within_a_frame() -> None:
    """A folded inner namespace is a box in the frame of the outer namespace."""
    shown = folded(picture(NESTED), {"/robot/arm/": True})
    frames = {frame.name: frame.members for frame in shown.frames}
    assert set(frames) == {"/robot/", "/robot/base/"}
    assert "namespace /robot/arm/" in frames["/robot/"]
    assert folded(picture(NESTED), {"/robot/": True, "/robot/arm/": True}).frames == ()


def test_a_large_graph_is_folded_unless_the_student_chose() -> None:
    """In a large graph, all namespaces are folded, except those that the student has unfolded."""
    crowd, few = picture(many(CROWD // 3)), picture(many(3))
    assert len(crowd.shapes) > CROWD
    assert len(folded(crowd, {}).shapes) == 2 + CROWD // 3
    opened = folded(crowd, {"/turtle4/": False})
    assert "/turtle4/pose" in names(opened)
    assert [frame.name for frame in opened.frames] == ["/turtle4/"]
    assert names(folded(few, {})) == names(few)


def test_a_namespace_with_most_shapes_is_not_folded() -> None:
    """If a namespace contains most of the graph's nodes and topics, the namespace is not folded."""
    parts = (("/all/sim", f"/all/turtle{n}/{kind}", "/all/watch") for n in range(12) for kind in "abc")
    shown = folded(picture(graph(*parts)), {})
    assert [frame.name for frame in shown.frames] == ["/all/"]
    assert len(shown.shapes) == 2 + 12


def test_a_box_shows_that_a_node_does_not_answer() -> None:
    """A folded namespace shows that one of its nodes does not respond."""
    seen = graph(("/robot/a", "/robot/x", "/robot/b"))
    nodes = tuple(NodeSeen(each.name, each.uri, "refused") for each in seen.nodes[:1]) + seen.nodes[1:]
    whole = picture(Snapshot(seen.master, nodes, seen.topics, seen.services))
    box = space("/robot/", whole, namespaces(whole)["/robot/"])
    assert not box.reachable
    assert dict(box.facts)["does not answer"] == "/robot/a"


def test_a_frame_contains_exactly_its_shapes() -> None:
    """A frame contains exactly the elements of its namespace."""
    layout = laid_out(folded(picture(NESTED), {}))
    assert [framed.frame.name for framed in layout.frames] == ["/robot/", "/robot/arm/", "/robot/base/"]
    for framed in layout.frames:
        left, top = framed.corner
        inside = {
            placed.shape.key
            for placed in layout.shapes
            if left < placed.centre[0] < left + framed.width and top < placed.centre[1] < top + framed.height
        }
        assert inside == framed.frame.members


def test_a_wide_drawing_is_turned_upright() -> None:
    """A long chain of nodes is drawn from top to bottom."""
    chain = graph(*((f"/node_{n}", f"/topic_{n}", f"/node_{n + 1}") for n in range(9)))
    layout = laid_out(picture(chain))
    assert layout.width < WIDE
    places = {placed.shape.name: placed.centre for placed in layout.shapes}
    assert places["/node_0"][1] < places["/topic_0"][1] < places["/node_9"][1]
    short = laid_out(picture(TURTLE))
    spots = {placed.shape.name: placed.centre for placed in short.shapes}
    assert spots["/teleop"][0] < spots["/turtle1/cmd_vel"][0] < spots["/sim"][0]


def test_frame_and_box_are_one_button_in_two_states() -> None:
    """A frame and its folded box have the same `data-key`, so that the keyboard focus does not change."""
    for fold, state in ((False, "true"), (True, "false")):
        root = ElementTree.fromstring(svg(laid_out(folded(picture(TURTLE), {"/turtle1/": fold}))))  # noqa: S314 - our own
        button = next(each for each in root.iter(f"{SVG}g") if each.get("data-key") == "namespace /turtle1/")
        assert (button.get("role"), button.get("tabindex"), button.get("aria-expanded")) == (
            "button",
            "0",
            state,
        )


def said() -> tuple[GraphModel, list[dict[str, object]]]:
    """Return a model, and the list of the messages that the model sends."""
    heard: list[dict[str, object]] = []
    return GraphModel(lambda **parts: heard.append(parts)), heard


def test_a_folded_namespace_stays_folded_when_the_graph_changes() -> None:
    """If the student has folded a namespace, it stays folded when a new node appears."""
    model, heard = said()
    model.see(TURTLE)
    assert heard[-1]["spaces"] == [{"name": "/turtle1/", "folded": False}]
    model.fold("/turtle1/", fold=True)
    assert heard[-1]["spaces"] == [{"name": "/turtle1/", "folded": True}]
    model.see(graph(("/sim", "/turtle1/pose", "/late"), ("/sim", "/turtle1/color", "/late")))
    assert heard[-1]["spaces"] == [{"name": "/turtle1/", "folded": True}]
    model.fold("", fold=False)
    assert heard[-1]["spaces"] == [{"name": "/turtle1/", "folded": False}]


def test_the_list_contains_folded_shapes() -> None:
    """The list below the drawing contains the elements of folded namespaces."""
    model, heard = said()
    model.see(TURTLE)
    before = heard[-1]["facts"]
    model.fold("/turtle1/", fold=True)
    assert heard[-1]["facts"] == before
    keys = [each["key"] for each in before]  # type: ignore[attr-defined]
    assert {"topic /turtle1/pose", "namespace /turtle1/"} <= set(keys)


@pytest.mark.parametrize("noise", [False, True])
def test_loggers_of_a_node_are_a_namespace(noise: bool) -> None:
    """If the panel shows the logger services, the two logger services of each node form a namespace."""
    loggers = {f"/sim/{name}": "/sim" for name in ("get_loggers", "set_logger_level")}
    shown = picture(graph(("/sim", "/pose", "/watch"), services=loggers), noise=noise)
    assert list(namespaces(shown)) == ["/sim/"] * noise
