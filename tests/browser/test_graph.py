"""The graph panel in a real browser: large graphs, folding, rates, calls, and pages without a kernel."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.graph import (
    Activity,
    Carried,
    NodeSeen,
    PrivateMaster,
    ServiceCaller,
    ServiceSeen,
    Snapshot,
    TopicSeen,
)
from course_pkg.panels import GraphPanel
from tests.browser.jupyter import Lab, panel, picture, running_notebook
from tests.browser.test_saved_panels import save

FAINT = Path(__file__).with_name("contrast.js").read_text()
NODES, TOPICS = 20, 40
TALK = """
from course_pkg import GraphPanel, join
from std_msgs.msg import String
from std_srvs.srv import Trigger
import rospy, threading
node = join("talk_test")
said = rospy.Publisher("/robot/said", String, queue_size=1)
rospy.Publisher("/robot/unheard", String, queue_size=1)
heard = node.subscribe("/robot/said", String)
node.serve("/robot/ask", Trigger, lambda _: (True, "yes"))
timer = rospy.Timer(rospy.Duration(0.1), lambda _: said.publish("word"))
"""
CALL = 'answer = node.call("/robot/ask", Trigger)'
LATER = 'node.serve("/later", Trigger, lambda _: (True, "here"))'


def large() -> Snapshot:
    """Make a graph of 20 nodes, 40 topics and 20 services, half of it in namespaces."""
    names = [f"/node_{number}" for number in range(NODES)]
    topics = [
        TopicSeen(
            f"/robot_{number % 4}/topic_{number}" if number % 2 else f"/topic_{number}",
            "std_msgs/String",
            (names[number % NODES],),
            tuple(sorted({names[(number + 1) % NODES], names[(3 * number + 2) % NODES]})),
        )
        for number in range(TOPICS)
    ]
    services = [
        ServiceSeen(f"{name}/start", "std_srvs/Trigger", name, "rosrpc://localhost:1", "answered")
        for name in names
    ]
    nodes = tuple(NodeSeen(name, "http://localhost:1/", "answered") for name in names)
    return Snapshot("http://localhost:11311", nodes, tuple(topics), tuple(services))


@pytest.fixture
def widget(master: PrivateMaster) -> GraphPanel:
    """A panel that has seen a large graph, with rates and a call."""
    assert master.uri
    shown, snapshot = GraphPanel(live=False), large()
    shown._model.see(snapshot)
    callers = {"/node_1/start": (ServiceCaller("/node_5", 12, time.time() - 3, 0),)}
    for turn in (0, 1):
        carried = tuple(
            Carried(topic.name, topic.publishers[0], name, 1, 20 * turn)
            for topic in snapshot.topics
            for name in topic.subscribers
        )
        shown._model.hear(Activity(2.0 * turn, carried, callers=callers))
    return shown


def shape(graph: Locator, key: str) -> Locator:
    """Find a shape or the title of a frame by its kind and name."""
    return graph.locator(f'[role="button"][data-key="{key}"]')


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 560])
def test_a_large_graph_can_be_read(
    widget: GraphPanel, page: Page, tmp_path: Path, theme: str, width: int
) -> None:
    """Names keep a size that can be read, the drawing scrolls within the panel, and nothing sticks out."""
    page.set_viewport_size({"width": width, "height": 1000})
    page.goto(save(widget, tmp_path / "page.html", theme))
    graph = panel(page, "Graph panel")
    expect(shape(graph, "topic /topic_0")).to_contain_text("10 Hz")
    shape(graph, "node /node_5").click()
    expect(graph.locator(".ros-details")).to_contain_text("called /node_1/start at ")
    assert graph.evaluate(FAINT) == []
    letters = graph.locator(".ros-shape text").first.evaluate("text => text.getBoundingClientRect().height")
    assert letters > 8
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    picture(page, f"graph-panel-large-{theme}-{width}")
    graph.get_by_role("button", name="Show the whole drawing").click()
    outside = "canvas => canvas.scrollWidth > canvas.clientWidth || canvas.scrollHeight > canvas.clientHeight"
    assert not graph.locator(".ros-canvas").evaluate(outside)
    picture(page, f"graph-panel-large-{theme}-{width}-whole")


def test_a_saved_namespace_tells_what_is_in_it(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """Without a kernel nothing unfolds, and the details say what is inside."""
    page.goto(save(widget, tmp_path / "page.html"))
    graph = panel(page, "Graph panel")
    box = shape(graph, "namespace /robot_1/")
    expect(box).to_have_attribute("aria-expanded", "false")
    expect(graph.get_by_text("this picture was saved")).not_to_be_attached()  # live=False never follows
    box.click()
    expect(graph.locator(".ros-details")).to_contain_text("/robot_1/topic_1 10 Hz")
    expect(box).to_have_attribute("aria-expanded", "false")


def test_paper_has_its_own_colours(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """In print a dark panel is black on white, whole, and without controls."""
    page.goto(save(widget, tmp_path / "page.html", "dark"))
    page.emulate_media(media="print")
    graph = panel(page, "Graph panel")
    fill = graph.locator(".ros-node ellipse").first.evaluate("shape => getComputedStyle(shape).fill")
    assert fill == "rgb(255, 255, 255)"
    ink = graph.locator(".ros-node text").first.evaluate("text => getComputedStyle(text).fill")
    assert ink == "rgb(0, 0, 0)"
    expect(graph.get_by_role("button", name="Larger")).to_be_hidden()
    cut = "canvas => canvas.scrollWidth > canvas.clientWidth + 1"
    assert not graph.locator(".ros-canvas").evaluate(cut)
    picture(page, "graph-panel-print")


def test_a_still_picture_stands_alone(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """The file is an image with a name, in colours of its own for light, dark and print."""
    file = tmp_path / "graph.svg"
    file.write_text(widget.svg(), encoding="utf-8")
    page.goto(file.as_uri())
    fill = "getComputedStyle(document.querySelector('.ros-node ellipse')).fill"
    fills = []
    for media, scheme in (("screen", "light"), ("screen", "dark"), ("print", "light")):
        page.emulate_media(media=media, color_scheme=scheme)  # type: ignore[arg-type]
        fills.append(page.evaluate(fill))
        picture(page, f"graph-still-{media}-{scheme}")
    assert fills == ["rgb(231, 240, 252)", "rgb(29, 51, 80)", "rgb(255, 255, 255)"]
    expect(page.get_by_role("img", name=re.compile("The ROS graph: 20 nodes"))).to_be_visible()


def test_a_panel_saved_by_an_older_release_still_shows(
    widget: GraphPanel, page: Page, tmp_path: Path
) -> None:
    """A state that has neither rates nor namespaces is a picture all the same."""
    address = tmp_path / "page.html"
    save(widget, address)
    text = re.sub(r'"(activity|spaces)":', r'"not_\1":', address.read_text())
    address.write_text(text)
    page.goto(address.as_uri())
    graph = panel(page, "Graph panel")
    shape(graph, "service /node_1/start").click()
    expect(graph.locator(".ros-details")).to_contain_text("std_srvs/Trigger")
    expect(graph.locator(".ros-details")).not_to_contain_text("called by")


def test_rates_callers_and_folds_follow_the_graph(lab: Lab, page: Page) -> None:
    """Rates and callers appear by themselves; what is folded by keyboard stays so when the graph changes."""
    delayed = f"threading.Timer(8, lambda: exec({LATER!r}, globals())).start()"
    with running_notebook(page, lab, "talk", TALK, CALL, "GraphPanel()", delayed):
        graph = panel(page, "Graph panel")
        expect(shape(graph, "topic /robot/said")).to_contain_text("10 Hz", timeout=20_000)
        expect(shape(graph, "topic /robot/unheard")).to_contain_text("no listener")
        shape(graph, "service /robot/ask").click()
        details = graph.locator(".ros-details")
        expect(details).to_contain_text("called by /talk_test")
        expect(details).to_contain_text("1 call")
        expect(graph.get_by_label("this notebook's node")).to_be_checked()
        picture(graph, "graph-panel-rates")
        shape(graph, "namespace /robot/").focus()
        page.keyboard.press("Enter")
        space = shape(graph, "namespace /robot/")
        expect(space).to_have_attribute("aria-expanded", "false")
        expect(space).to_be_focused()
        expect(shape(graph, "topic /robot/said")).not_to_be_attached()
        expect(details).to_contain_text("/robot/said 10 Hz")
        expect(shape(graph, "service /later")).to_be_visible(timeout=20_000)
        expect(space).to_have_attribute("aria-expanded", "false")
        picture(graph, "graph-panel-folded")
        page.keyboard.press("Enter")
        expect(shape(graph, "topic /robot/said")).to_contain_text("10 Hz")
