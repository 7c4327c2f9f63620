"""Tests of the graph panel in a real browser, with and without a kernel."""

from __future__ import annotations

import itertools
import re
import time
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.panels import GraphPanel
from course_pkg.panels.graph.history import History
from course_pkg.ros import (
    Activity,
    NodeSeen,
    PrivateMaster,
    ServiceCaller,
    ServiceSeen,
    Snapshot,
    TopicSeen,
    Traffic,
)
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import FAINT, panel, picture, save
from tests.support import usual

FRAMES = "async (count) => { while (count--) await new Promise(requestAnimationFrame) }"
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
rospy.Service("/robot/ask", Trigger, lambda _: (True, "yes"))
timer = rospy.Timer(rospy.Duration(0.1), lambda _: said.publish("word"))
"""
CALL = 'answer = node.call("/robot/ask", Trigger)'
LATER = 'rospy.Service("/later", Trigger, lambda _: (True, "here"))'


def large() -> Snapshot:
    """Return a graph of 20 nodes, 40 topics and 20 services."""
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
    """Return a panel of a large graph, with rates and a call."""
    assert master.uri
    shown, snapshot = GraphPanel(live=False), large()
    shown._model.see(snapshot)
    callers = {"/node_1/start": (ServiceCaller("/node_5", 12, time.time() - 3, 0),)}
    for turn in (0, 1):
        carried = tuple(
            Traffic(topic.name, topic.publishers[0], name, 1, 20 * turn)
            for topic in snapshot.topics
            for name in topic.subscribers
        )
        shown._model.count(Activity(2.0 * turn, carried, callers=callers))
    return shown


def shape(graph: Locator, key: str) -> Locator:
    """Return the element of a node, topic, service or frame; the argument is the key of the element."""
    return graph.locator(f'[role="button"][data-key="{key}"]')


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", usual(1, {"560": 560, "1280": 1280}))
def test_a_large_graph_can_be_read(
    widget: GraphPanel, page: Page, tmp_path: Path, theme: str, width: int
) -> None:
    """The drawing of a large graph scrolls within the panel, and its names have a readable size."""
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


def test_a_saved_namespace_lists_its_shapes(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """On a saved page, a click on a folded namespace shows the nodes and topics in this namespace."""
    page.goto(save(widget, tmp_path / "page.html"))
    graph = panel(page, "Graph panel")
    box = shape(graph, "namespace /robot_1/")
    expect(box).to_have_attribute("aria-expanded", "false")
    # With live=False, the panel does not show the sentence "this is a saved picture".
    expect(graph.get_by_text("this is a saved picture")).not_to_be_attached()
    box.click()
    expect(graph.locator(".ros-details")).to_contain_text("/robot_1/topic_1 10 Hz")
    expect(box).to_have_attribute("aria-expanded", "false")


def played(widget: GraphPanel) -> GraphPanel:
    """Record a panel for eight seconds while the graph changes."""
    whole, began = large(), time.time() - 100
    half = Snapshot(whole.master, whole.nodes[:10], whole.topics[:8], whole.services[:10])

    def heard(last: float, running: int) -> None:
        caller = ServiceCaller("/node_5", 12, last, running)
        widget._model.count(Activity(last, callers={"/node_1/start": (caller,)}))

    steps = [
        lambda: heard(began - 60, 0),
        lambda: heard(began + 2, 1),
        lambda: heard(began + 4, 0),
        lambda: widget._model.see(half),
    ]
    history = History()
    history.start(began, *widget._showing())
    for number, step in enumerate(steps):
        step()
        history.add(began + 2 * number, *widget._showing())
    widget.publish(history=history.state(began + 8), live=True)
    return widget


def seek(graph: Locator, seconds: float) -> None:
    """Move the slider to a time of the recording (in s)."""
    graph.get_by_label("Moment of the recording").fill(str(round(1000 * seconds)))


@pytest.mark.parametrize("theme", usual(1, {"light": "light", "dark": "dark"}))
def test_a_recording_of_the_graph_is_played_without_a_kernel(
    widget: GraphPanel, page: Page, tmp_path: Path, theme: str
) -> None:
    """The slider selects a time of the recording, and the Play button starts the playback."""
    page.set_viewport_size({"width": 560, "height": 900})
    page.goto(save(played(widget), tmp_path / "page.html", theme))
    graph = panel(page, "Graph panel")
    expect(graph.get_by_text("No kernel answers: this is a recording.")).to_be_visible()
    expect(graph.get_by_text("8.0 of 8.0 s")).to_be_visible()
    expect(shape(graph, "node /node_15")).not_to_be_attached()
    seek(graph, 5)
    handle = graph.get_by_role("slider")
    expect(handle).to_have_attribute("aria-valuetext", "5.0 of 8.0 seconds")
    expect(shape(graph, "node /node_15")).to_be_visible()
    shape(graph, "service /node_1/start").click()
    expect(graph.locator(".ros-details")).to_contain_text("called by /node_5 just now, 12 calls")
    expect(graph.locator(".ros-calls .ros-asked")).to_have_count(1)
    seek(graph, 3)
    expect(graph.locator(".ros-calls .ros-waits")).to_have_count(1)
    expect(graph.locator(".ros-details")).to_contain_text("waits for the response")
    picture(page, f"graph-panel-recorded-{theme}")
    handle.press("ArrowRight")
    expect(graph.get_by_text("3.1 of 8.0 s")).to_be_visible()
    assert graph.evaluate(FAINT) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    seek(graph, 1)
    expect(graph.locator(".ros-calls .ros-asked")).to_have_count(0)
    seek(graph, 7.5)
    graph.get_by_role("button", name="Play").click()
    expect(graph.get_by_text("8.0 of 8.0 s")).to_be_visible()
    expect(graph.get_by_role("button", name="Play")).to_be_visible()
    expect(shape(graph, "node /node_15")).not_to_be_attached()


def test_a_recording_does_not_play_out_of_sight(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """The recording pauses while the panel is not visible on the page.

    If the reader's system asks for reduced motion, the page shows one picture per second.
    """
    page.emulate_media(reduced_motion="reduce")
    page.goto(save(played(widget), tmp_path / "page.html"))
    graph = panel(page, "Graph panel")
    expect(graph.get_by_text("8.0 of 8.0 s")).to_be_visible()
    page.evaluate(
        """() => {
            globalThis.said = [];
            new MutationObserver(() => said.push(document.querySelector("output").textContent))
                .observe(document.querySelector("output"), { childList: true });
        }"""
    )
    graph.get_by_role("button", name="Play").click()
    page.wait_for_function("said.length >= 3")
    times = [float(text.split()[0]) for text in page.evaluate("said")]
    assert all(after - before >= 1 for before, after in itertools.pairwise(times))
    page.evaluate("document.body.style.paddingTop = '5000px'")
    page.wait_for_function("document.querySelector('.ros-graph').getBoundingClientRect().top > innerHeight")
    page.evaluate(FRAMES, 10)  # Wait until the page reports that the panel is not visible.
    stood = page.evaluate("said.length")
    page.evaluate(FRAMES, 150)
    assert page.evaluate("said.length") == stood
    expect(graph.get_by_role("button", name="Pause")).to_be_attached()


def test_lines_of_calls_are_drawn_on_a_saved_page(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """A saved panel draws the lines of calls at the right positions."""
    troubles: list[str] = []
    page.on("console", lambda said: troubles.append(said.text) if said.type in ("error", "warning") else None)
    page.goto(save(widget, tmp_path / "page.html"))
    lines = panel(page, "Graph panel").locator(".ros-calls path")
    expect(lines).to_have_count(1)
    assert "NaN" not in (lines.get_attribute("d") or "")
    assert troubles == []


def test_print_has_its_own_colours(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """In print, a dark panel is black on white, and has no buttons."""
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


def test_a_still_picture_is_complete(widget: GraphPanel, page: Page, tmp_path: Path) -> None:
    """The downloaded picture has a title, and colours for the light theme, the dark theme and print."""
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
    """The page draws a panel that was saved by an older release and has no rates and no namespaces."""
    address = tmp_path / "page.html"
    save(widget, address)
    text = re.sub(r'"(activity|spaces)":', r'"not_\1":', address.read_text())
    address.write_text(text)
    page.goto(address.as_uri())
    graph = panel(page, "Graph panel")
    shape(graph, "service /node_1/start").click()
    expect(graph.locator(".ros-details")).to_contain_text("std_srvs/Trigger")
    expect(graph.locator(".ros-details")).not_to_contain_text("called by")


def test_rates_callers_and_folds_follow_the_graph(lab: Lab, lab_page: Page) -> None:
    """If the student has folded a namespace, it stays folded when the graph changes."""
    delayed = f"threading.Timer(8, lambda: exec({LATER!r}, globals())).start()"
    with running_notebook(lab_page, lab, "talk", TALK, CALL, "GraphPanel()", delayed):
        graph = panel(lab_page, "Graph panel")
        expect(shape(graph, "topic /robot/said")).to_contain_text("10 Hz")
        expect(shape(graph, "topic /robot/unheard")).to_contain_text("not received")
        shape(graph, "service /robot/ask").click()
        details = graph.locator(".ros-details")
        expect(details).to_contain_text("called by /talk_test")
        expect(details).to_contain_text("1 call")
        expect(graph.get_by_label("this notebook's node")).to_be_checked()
        picture(graph, "graph-panel-rates")
        shape(graph, "namespace /robot/").focus()
        lab_page.keyboard.press("Enter")
        space = shape(graph, "namespace /robot/")
        expect(space).to_have_attribute("aria-expanded", "false")
        expect(space).to_be_focused()
        expect(shape(graph, "topic /robot/said")).not_to_be_attached()
        expect(details).to_contain_text("/robot/said 10 Hz")
        expect(shape(graph, "service /later")).to_be_visible()
        expect(space).to_have_attribute("aria-expanded", "false")
        picture(graph, "graph-panel-folded")
        lab_page.keyboard.press("Enter")
        expect(shape(graph, "topic /robot/said")).to_contain_text("10 Hz")
