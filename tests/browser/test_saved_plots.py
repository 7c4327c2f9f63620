"""Plots, choices and topic panels on a page without a kernel, read by eye, pointer, keyboard, on paper."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.graph import PrivateMaster
from course_pkg.panels import Plot, TopicPanel
from course_pkg.panels.choices.store import ChoiceStore
from course_pkg.panels.choices.view import Choices
from tests.browser.jupyter import panel, picture
from tests.browser.test_saved_panels import save

DELAYS = {
    "by polling": [(0.0, 12.0), (1.0, 14.5), (2.0, 11.0)],
    "by topic": [(0.0, 3.0), (1.0, 2.5), (2.0, math.nan), (3.0, 4.0)],
}
AXES = {"x": "time (s)", "y": "delay (ms)"}
CASES = [
    ("Joint values on `/joint_states`", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
]

# Functions of the page.
FAINT, OVERLAPS, COLOURS = (
    Path(__file__).with_name(f"{name}.js").read_text() for name in ("contrast", "overlaps", "colours")
)


def canvas(plot: Locator) -> Locator:
    """Find what can be pointed at."""
    return plot.get_by_role("group", name="Plot: the arrow keys read its points")


def test_a_plot_is_read_by_keyboard_and_pointer(page: Page, tmp_path: Path) -> None:
    """The arrow keys go from point to point and from series to series; the pointer finds the next point."""
    page.goto(save(Plot(DELAYS, title="How late?", **AXES), tmp_path / "page.html"))
    plot = panel(page, "Plot: How late?")
    readout = plot.get_by_role("status")
    expect(readout).to_have_text("Point at the plot, or use the arrow keys, to read its values.")
    canvas(plot).focus()
    page.keyboard.press("ArrowRight")
    expect(readout).to_have_text("by polling: time 0 s, delay 12 ms")
    page.keyboard.press("ArrowRight")
    expect(readout).to_have_text("by polling: time 1 s, delay 14.5 ms")
    page.keyboard.press("ArrowDown")
    expect(readout).to_have_text("by topic: time 1 s, delay 2.5 ms")
    page.keyboard.press("End")
    expect(readout).to_have_text("by topic: time 3 s, delay 4 ms")
    page.keyboard.press("Escape")
    expect(readout).to_contain_text("Point at the plot")
    box = canvas(plot).bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] - 16, box["y"] + box["height"] / 2)
    expect(readout).to_have_text("by topic: time 3 s, delay 4 ms")


def test_a_plot_says_the_same_as_a_table(page: Page, tmp_path: Path) -> None:
    """Every value is there in words, with what was left out, and nothing says that a kernel is missing."""
    page.goto(save(Plot(DELAYS, **AXES), tmp_path / "page.html"))
    plot = panel(page, "Plot")
    expect(plot.get_by_text("1 point of 'by topic' is left out: not a finite number.")).to_be_visible()
    plot.get_by_text("The same as a table").click()
    expect(plot.get_by_role("row", name="by polling 1 14.5")).to_be_visible()
    expect(plot.get_by_role("columnheader", name="delay (ms)").last).to_be_visible()
    expect(plot.get_by_text("kernel")).to_have_count(0)


def test_series_differ_without_colour(page: Page, tmp_path: Path) -> None:
    """Each of six has a dash and a marker of its own."""
    series = {f"series {number}": [(0.0, number), (1.0, number + 1.0)] for number in range(6)}
    page.goto(save(Plot(series, **AXES), tmp_path / "page.html"))
    items = panel(page, "Plot").get_by_role("listitem")
    expect(items).to_have_count(6)
    markers = {items.nth(number).locator("path").get_attribute("d") for number in range(6)}
    dashes = {items.nth(number).locator("line").get_attribute("stroke-dasharray") for number in range(6)}
    assert len(markers) == len(dashes) == 6


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("kind", ["line", "dots", "bars", "log"])
def test_a_plot_can_be_read_in_both_themes_and_fits(
    page: Page, tmp_path: Path, theme: str, kind: str
) -> None:
    """At 560 px nothing overflows, no mark lies over another, and every colour stands out from its ground."""
    page.set_viewport_size({"width": 560, "height": 700})
    bars = {"a connection for each call": 12.5, "persistent": 0.4, "by topic": 3.25}
    plots = {
        "line": lambda: Plot(DELAYS, title="Lines", **AXES),
        "dots": lambda: Plot(DELAYS, kind="dots", title="Dots", **AXES),
        "bars": lambda: Plot(bars, kind="bars", title="Bars", y="delay (ms)"),
        "log": lambda: Plot(bars, kind="bars", title="Log bars", y="delay (ms)", log=True),
    }
    page.goto(save(plots[kind](), tmp_path / "page.html", theme))
    plot = page.locator(".ros-plot")
    expect(plot.locator("svg text").first).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    assert plot.evaluate(FAINT) == []
    assert plot.evaluate(OVERLAPS) == []
    assert min(plot.evaluate(COLOURS)) >= 4.5
    picture(plot, f"plot-{kind}-{theme}")


def test_paper_is_white(page: Page, tmp_path: Path) -> None:
    """In print a plot is light, whatever the theme, and what only a pointer can use is not there."""
    page.goto(save(Plot(DELAYS, **AXES), tmp_path / "page.html", "dark"))
    plot = panel(page, "Plot")
    page.emulate_media(media="print")
    assert plot.evaluate("element => getComputedStyle(element).colorScheme") == "light"
    assert plot.evaluate("element => getComputedStyle(element).backgroundColor") == "rgb(255, 255, 255)"
    expect(plot.get_by_role("status")).to_be_hidden()
    expect(plot.locator("polyline")).to_have_count(3)


def test_ten_thousand_points_keep_their_outliers(page: Page, tmp_path: Path) -> None:
    """What stands out is drawn at its place, though most points are not."""
    draw = random.Random(3)  # noqa: S311 - noise, no secret
    points = [(index / 1000, draw.gauss(1.0, 0.1)) for index in range(10_000)]
    points[7000] = (7.0, 40.0)
    page.goto(save(Plot({"delay": points}, **AXES), tmp_path / "page.html"))
    plot = panel(page, "Plot")
    expect(plot.get_by_text("in each of 960 columns are drawn")).to_be_visible()
    places = plot.locator("polyline").get_attribute("points")
    assert places is not None
    pairs = [tuple(map(float, pair.split(","))) for pair in places.split()]
    assert len(pairs) <= 4 * 960
    top = min(pairs, key=lambda pair: pair[1])
    box = plot.locator("svg[role=img]").bounding_box()
    assert box is not None
    assert 0.6 < top[0] / box["width"] < 0.8
    picture(plot, "plot-many")


def test_nothing_measured_is_said(page: Page, tmp_path: Path) -> None:
    """An empty plot is no blank."""
    page.goto(save(Plot({"topic": []}, title="Empty", **AXES), tmp_path / "page.html"))
    expect(page.get_by_text("Nothing was measured.")).to_be_visible()
    page.goto(save(Plot({}, kind="bars"), tmp_path / "bars.html"))
    expect(page.get_by_text("Nothing was measured.")).to_be_visible()


def test_saved_choices_can_be_read(page: Page, tmp_path: Path) -> None:
    """What was chosen and why it fits is there; nothing can be chosen, and a sentence says why."""
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


def test_a_saved_topic_panel_says_that_it_is_one(page: Page, tmp_path: Path, master: PrivateMaster) -> None:
    """The form and the commands are there, the buttons are out of use, and a sentence says why."""
    assert master.uri
    page.set_viewport_size({"width": 560, "height": 1200})
    page.goto(save(TopicPanel("/speed", "std_msgs/Float64"), tmp_path / "page.html"))
    topic = panel(page, "Topic panel")
    expect(topic.get_by_text("No kernel answers: this is what the panel saw last.")).to_be_visible()
    expect(topic.get_by_role("button", name="Publish", exact=True)).to_be_disabled()
    topic.get_by_text("The same by hand").click()
    once = topic.get_by_label("Command that publishes once")
    expect(once).to_have_text("rostopic pub --once /speed std_msgs/Float64 0.0")
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    assert topic.evaluate(FAINT) == []
    picture(topic, "topic-panel-saved")
