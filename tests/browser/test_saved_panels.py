"""Tests of panels on a saved page without a kernel."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.panels import GraphPanel, ServicePanel, TopicPanel
from course_pkg.panels.choices.model import ChoiceStore
from course_pkg.panels.choices.view import Choices
from course_pkg.panels.prediction.model import PredictionStore
from course_pkg.panels.prediction.view import Question
from tests.browser.pages import FAINT, panel, picture, save

pytestmark = pytest.mark.usefixtures("server")

CASES = [
    ("Joint values on `/joint_states`", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
]

# These functions run in the page.
OVERLAPS, COLOURS = (Path(__file__).with_name(f"{name}.js").read_text() for name in ("overlaps", "colours"))


def answer(form: Locator, name: str) -> Locator:
    """Return the value of a field of the response."""
    return form.get_by_role("row", name=name).get_by_role("cell").first


def test_a_saved_service_panel_says_that_it_is_saved(page: Page, tmp_path: Path) -> None:
    """A saved service panel shows the last response, and the Call button is disabled."""
    widget = ServicePanel("/getGeometry")
    widget.call(length=2.0, width=3.0, height=4.0)
    page.goto(save(widget, tmp_path / "page.html"))
    form = panel(page)
    expect(form.get_by_text("No kernel answers: this is a saved panel.")).to_be_visible()
    expect(form.get_by_role("button", name="Call")).to_be_disabled()
    expect(answer(form, "volume")).to_have_text("24.0")
    expect(form.get_by_label("length")).to_have_value("2.0")
    form.get_by_label("length").fill("7")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_recording_replaces_the_kernel(page: Page, tmp_path: Path, theme: str) -> None:
    """A recorded request gets its recorded response. Any other request gets an error message."""
    widget = ServicePanel("/getGeometry")
    widget.record(
        [{"length": 1.0, "width": 2.0, "height": 3.0}, {"length": 4.0, "width": 5.0, "height": 6.0}]
    )
    page.set_viewport_size({"width": 390, "height": 1200})
    page.goto(save(widget, tmp_path / "page.html", theme))
    form = panel(page)
    expect(form.get_by_text("The responses here were recorded from a real server")).to_be_visible()
    for name, text in {"length": "1", "width": "2.00", "height": "3e0"}.items():
        form.get_by_label(name).fill(text)
    form.get_by_role("button", name="Call").click()
    expect(form.get_by_text("Recorded: Answered in")).to_be_visible()
    expect(answer(form, "volume")).to_have_text("6.0")
    expect(form.get_by_label("Command for a terminal")).to_have_text(
        "rosservice call /getGeometry 1.0 2.0 3.0"
    )
    form.get_by_label("height").fill("9")
    form.get_by_role("button", name="Call").click()
    expect(form.get_by_text("This request was not recorded.")).to_be_visible()
    form.get_by_text("Recorded requests (2)").click()
    form.get_by_role("button", name="length 4.0").click()
    form.get_by_role("button", name="Call").click()
    expect(answer(form, "area")).to_have_text("20.0")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    picture(page, f"service-panel-recorded-{theme}")


def test_shapes_of_a_saved_graph_can_be_clicked(page: Page, tmp_path: Path) -> None:
    """A click on a shape of a saved graph shows its details."""
    page.goto(save(GraphPanel(), tmp_path / "page.html"))
    graph = panel(page, "Graph panel")
    expect(graph.get_by_text("this is a saved picture")).to_be_visible()
    graph.get_by_role("button", name="service /getGeometry").click()
    expect(graph.locator(".ros-details")).to_contain_text("course_pkg/geometry")


def test_a_saved_question_is_disabled(page: Page, tmp_path: Path) -> None:
    """On a saved page, the reader cannot enter a prediction."""
    store = PredictionStore(tmp_path / "predictions.json")
    page.goto(save(Question("05.x", "What?", ["this", "that"], store=store), tmp_path / "page.html"))
    expect(page.get_by_text("run the notebook to store a prediction")).to_be_visible()
    expect(page.get_by_label("this")).to_be_disabled()


def test_saved_choices_can_be_read(page: Page, tmp_path: Path) -> None:
    """A saved page shows the choices and the reasons, and the reader cannot change the choices."""
    widget = Choices(
        "03.x", "Which fits?", ["a topic", "a service"], CASES, store=ChoiceStore(tmp_path / "c.json")
    )
    for number in range(2):
        widget.received("choose", {"case": number, "option": "a topic"})
    widget.received("compare", {})
    page.set_viewport_size({"width": 560, "height": 700})
    page.goto(save(widget, tmp_path / "page.html", "dark"))
    choices = panel(page, "Choices")
    expect(choices.get_by_text("No kernel answers: run the notebook to choose.")).to_be_visible()
    expect(choices.get_by_text("Does not fit. Better: a service.")).to_be_visible()
    expect(
        choices.get_by_role("radiogroup", name="One picture, on demand").get_by_label("a topic")
    ).to_be_disabled()
    assert choices.locator("code").first.inner_text() == "/joint_states"
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    assert choices.evaluate(FAINT) == []
    picture(choices, "choices-saved-dark")


def test_a_saved_topic_panel_says_that_it_is_saved(page: Page, tmp_path: Path) -> None:
    """A saved topic panel shows the form and the commands, and its buttons are disabled."""
    page.set_viewport_size({"width": 560, "height": 1200})
    page.goto(save(TopicPanel("/speed", "std_msgs/Float64"), tmp_path / "page.html"))
    topic = panel(page, "Topic panel")
    expect(topic.get_by_text("No kernel answers: this is the last saved state of the panel.")).to_be_visible()
    expect(topic.get_by_role("button", name="Publish", exact=True)).to_be_disabled()
    topic.get_by_text("The same as commands and in Python").click()
    once = topic.get_by_label("Command that publishes once")
    expect(once).to_have_text("rostopic pub --once /speed std_msgs/Float64 0.0")
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    assert topic.evaluate(FAINT) == []
    picture(topic, "topic-panel-saved")


CURVE = {"points": [[0.0, 12.0], [1.0, 14.5], [2.0, -11.0], [3.0, 2.25]], "count": 4, "left_out": 1}


def chart(page: Page, folder: Path, curve: dict[str, object], theme: str = "light") -> Locator:
    """Open a saved topic panel with a plot, and return its chart."""
    widget = TopicPanel("/speed", "std_msgs/Float64")
    widget.publish(curve=json.dumps(curve))
    page.goto(save(widget, folder / "page.html", theme))
    return panel(page, "Topic panel").get_by_role("region", name="Plot")


def test_a_chart_is_read_by_keyboard_and_pointer(page: Page, tmp_path: Path) -> None:
    """The arrow keys select the next point of the chart, and the pointer selects the nearest point."""
    drawn = chart(page, tmp_path, CURVE)
    canvas = drawn.get_by_role("group", name="Plot: the arrow keys read its points")
    readout = drawn.get_by_role("status").last
    expect(readout).to_have_text("Point at the plot, or use the arrow keys, to read its values.")
    expect(drawn.get_by_role("img")).to_have_attribute(
        "aria-label", "a line of 4 points, data against time since the subscription began (s)"
    )
    expect(drawn.get_by_text("1 of 4 values are not drawn")).to_be_visible()
    canvas.focus()
    since = "time since the subscription began"
    for key, text in {
        "ArrowRight": f"{since} 0 s, data 12",
        "End": f"{since} 3 s, data 2.25",
        "ArrowLeft": f"{since} 2 s, data -11",
        "PageUp": f"{since} 0 s, data 12",
    }.items():
        page.keyboard.press(key)
        expect(readout).to_have_text(text)
    page.keyboard.press("Escape")
    expect(readout).to_contain_text("Point at the plot")
    box = canvas.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 60, box["y"] + box["height"] / 2)
    expect(readout).to_contain_text(f"{since} ")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_chart_can_be_read_in_both_themes_and_fits(page: Page, tmp_path: Path, theme: str) -> None:
    """At a width of 560 px, the labels do not overlap, and the curve has enough contrast."""
    page.set_viewport_size({"width": 560, "height": 1200})
    drawn = chart(page, tmp_path, CURVE, theme)
    expect(drawn.locator("svg text").first).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    assert drawn.evaluate(FAINT) == []
    assert drawn.evaluate(OVERLAPS) == []
    assert page.locator(".ros-panel").evaluate(COLOURS) >= 4.5
    picture(drawn, f"chart-{theme}")


def test_a_long_curve_has_no_markers_and_an_empty_one_says_so(page: Page, tmp_path: Path) -> None:
    """A plot with many points has no markers, and an empty plot shows a message."""
    points = [[index / 50, math.sin(index / 20)] for index in range(1000)]
    drawn = chart(page, tmp_path, {"points": points, "count": 1000, "left_out": 0})
    line = drawn.locator("polyline")
    assert len((line.get_attribute("points") or "").split()) == 1000
    expect(drawn.locator(".ros-chart-marker")).to_have_count(0)
    drawn = chart(page, tmp_path, {"points": [], "count": 0, "left_out": 0})
    expect(drawn.get_by_text("Nothing to draw yet.")).to_be_visible()
