"""Tests of the timeline on a page and in JupyterLab."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import FloatRect, Locator, Page, expect

from course_pkg.panels import Timeline
from course_pkg.ros import Event, Recording
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import FAINT, panel, picture, save

# The function counts the different colours in 9 x 9 pixels around a point of the drawing.
COLOURS = """(canvas, [x, y]) => {
    const data = canvas.getContext("2d").getImageData(x - 4, y - 4, 9, 9).data
    return new Set(Array.from({length: 81}, (_, each) => data.slice(4 * each, 4 * each + 3).join())).size
}"""
LENGTH = 1.0  # s

# The drawing is longer than the recording. At each end of the drawing, this fraction of the recording's
# duration is added.
EDGE = 0.02


def recording(*more: Event, open_end: bool = False) -> Recording:
    """Return a recording of a call that takes 0.5 s, and of messages at 20 Hz."""
    key, mine, theirs = "call 1", ("/customer", "/detect"), ("/cashier", "/detect")
    end = None if open_end else 0.7
    events = [
        Event("lookup", *mine, 0.2, 0.201, "master", key, "MainThread"),
        Event("connect", *mine, 0.201, 0.202, "/cashier", key, "MainThread"),
        Event("request", *mine, 0.202, 0.2021, "/cashier", key, "MainThread"),
        Event("wait", *mine, 0.2021, end, "/cashier", key, "MainThread"),
        Event("handler", *theirs, 0.2025, end and 0.6995, "/customer", key, "Thread-1 (handle)"),
        *([] if open_end else [Event("response", *mine, 0.7, 0.7, "/cashier", key, "MainThread")]),
        *more,
    ]
    for number in range(19):
        at, key = 0.05 + number / 20, f"message {number}"
        events.append(Event("publish", "/robot", "/joints", at, at + 1e-4, "/simulator", key, "MainThread"))
        events.append(
            Event("callback", "/simulator", "/joints", at + 2e-4, at + 0.01, "/robot", key, "/joints")
        )
    return Recording(
        "/customer",
        tuple(sorted(events, key=lambda event: event.start)),
        ("/idle",),
        {"/old": "it keeps no record"},
        (),
        LENGTH,
    )


def show(page: Page, folder: Path, given: Recording, theme: str = "light") -> Locator:
    """Open a saved page with the timeline of a recording, and wait until the drawing has a width."""
    page.goto(save(Timeline(given), folder / "page.html", theme))
    timeline = panel(page, "Timeline")
    if drawing(timeline).count():
        expect(drawing(timeline)).to_have_attribute("style", re.compile("width: [1-9]"))
    return timeline


def drawing(timeline: Locator) -> Locator:
    """Return the drawing of the timeline."""
    return timeline.locator("canvas.ros-body")


def spot(timeline: Locator, time: float, lane: int) -> tuple[float, float]:
    """Return the position of an event in the drawing; `time` is in s, and `lane` is the node's index."""
    box = drawing(timeline).bounding_box()
    assert box is not None
    return box["width"] * (time / LENGTH + EDGE) / (1 + 2 * EDGE), 4 + 22 + 10 + lane * (22 + 23 + 12)


def click(page: Page, timeline: Locator, time: float, lane: int) -> None:
    """Click in the row of a node; `time` is in s, and `lane` is the node's index."""
    x, y = spot(timeline, time, lane)
    drawing(timeline).click(position={"x": x, "y": y})


def ticks(timeline: Locator) -> bytes:
    """Return a screenshot of the time axis."""
    return timeline.locator("canvas.ros-axis").screenshot()


def drawn(page: Page) -> None:
    """Wait until the page has drawn the last change."""
    page.evaluate("new Promise(requestAnimationFrame)")


def test_a_click_describes_the_event(page: Page, tmp_path: Path) -> None:
    """A click on an event shows its description, and a click on an empty position hides the description."""
    timeline = show(page, tmp_path, recording())
    details = timeline.locator(".ros-details")
    expect(details).to_contain_text("Click an event")
    click(page, timeline, 0.45, 2)
    expect(details).to_contain_text("/customer waited 498 ms for /cashier to answer on /detect.")
    expect(details).to_contain_text("handler (/cashier) 497 ms")
    picture(timeline, "timeline-chosen")
    click(page, timeline, 0.45, 3)
    expect(details).to_contain_text("/cashier worked for 497 ms on /detect for /customer.")
    click(page, timeline, 0.055, 1)
    expect(details).to_contain_text(
        "/simulator spent 9.8 ms in a callback for a message on /joints from /robot."
    )
    click(page, timeline, 0.9, 2)
    expect(details).to_contain_text("Click an event")


def test_waiting_is_hatched(page: Page, tmp_path: Path) -> None:
    """The bar of a waiting caller is striped, and the bar of a handler has one colour."""
    timeline = show(page, tmp_path, recording())
    colours = {
        lane_and_time: drawing(timeline).evaluate(COLOURS, spot(timeline, *reversed(lane_and_time)))
        for lane_and_time in ((2, 0.6), (3, 0.6), (3, 0.9))
    }
    assert colours[2, 0.6] > 3
    assert colours[3, 0.6] == 1
    assert colours[3, 0.9] == 1
    assert (
        drawing(timeline).evaluate("canvas => canvas.getContext('2d').getImageData(0, 0, 1, 1).data.length")
        == 4
    )


def test_the_keyboard_is_sufficient(page: Page, tmp_path: Path) -> None:
    """The down and up keys select an event, Enter zooms in on this event, and 0 shows all events."""
    timeline = show(page, tmp_path, recording())
    details, whole = timeline.locator(".ros-details"), ticks(timeline)
    drawing(timeline).focus()
    page.keyboard.press("ArrowDown")
    expect(details).to_contain_text(
        "/robot published on /joints and did not wait. 1 callback received the message."
    )
    page.keyboard.press("ArrowDown")
    expect(details).to_contain_text("/simulator spent")
    page.keyboard.press("ArrowUp")
    expect(details).to_contain_text("/robot published")
    page.keyboard.press("Enter")
    drawn(page)
    near = ticks(timeline)
    assert near != whole
    page.keyboard.press("ArrowRight")
    drawn(page)
    assert ticks(timeline) != near
    page.keyboard.press("0")
    drawn(page)
    assert ticks(timeline) == whole
    page.keyboard.press("Escape")
    expect(details).to_contain_text("Click an event")


def test_look_up_and_connection_become_bars(page: Page, tmp_path: Path) -> None:
    """When the student zooms in on a short event, the event becomes a bar."""
    timeline = show(page, tmp_path, recording())
    drawing(timeline).focus()
    details = timeline.locator(".ros-details")
    while "asked the master" not in details.inner_text():
        page.keyboard.press("ArrowDown")
    expect(details).to_contain_text("/customer asked the master for the address of /detect, and waited 1 ms.")
    for _ in range(7):
        page.keyboard.press("+")
    drawn(page)
    picture(timeline, "timeline-zoomed")
    box: FloatRect | None = drawing(timeline).bounding_box()
    assert box is not None
    # The look-up of the service starts at this fraction of the drawing's width, before and after the zoom.
    share = (0.2 / LENGTH + EDGE) / (1 + 2 * EDGE)
    wide = box["width"] / (LENGTH * (1 + 2 * EDGE)) * 2**7 * 0.001
    assert wide > 50
    y = spot(timeline, 0, 2)[1]
    drawing(timeline).click(position={"x": box["width"] * share + wide * 1.5, "y": y})
    expect(details).to_contain_text("/customer connected to /cashier to call /detect. This took 1 ms.")


def test_wheel_and_drag(page: Page, tmp_path: Path) -> None:
    """Ctrl with the mouse wheel zooms, and a drag of the mouse moves the visible time range."""
    timeline = show(page, tmp_path, recording())
    whole = ticks(timeline)
    drawing(timeline).hover(position={"x": 300, "y": 60})
    page.mouse.wheel(0, 200)
    drawn(page)
    assert ticks(timeline) == whole
    page.keyboard.down("Control")
    page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    drawn(page)
    near = ticks(timeline)
    assert near != whole
    page.mouse.down()
    page.mouse.move(500, 300, steps=5)
    page.mouse.up()
    drawn(page)
    assert ticks(timeline) != near
    expect(timeline.locator(".ros-details")).to_contain_text("Click an event")
    timeline.get_by_role("button", name="Show all").click()
    drawn(page)
    assert ticks(timeline) == whole


def test_the_same_as_a_table(page: Page, tmp_path: Path) -> None:
    """The page describes each node in sentences, and lists all events in a table."""
    timeline = show(page, tmp_path, recording())
    expect(timeline.get_by_text("/customer waited for /cashier on /detect: 500 ms.")).to_be_visible()
    expect(timeline.get_by_text("/robot published 19 messages on /joints")).to_be_visible()
    expect(timeline.get_by_text("Recorded without events: /idle.")).to_be_visible()
    expect(timeline.get_by_text("Not recorded: /old, because it keeps no record.")).to_be_visible()
    timeline.get_by_text("The same as a table").click()
    expect(timeline.get_by_role("row")).to_have_count(1 + 6 + 2 * 19)
    expect(timeline.get_by_role("row", name="wait")).to_contain_text("202.100")
    expect(timeline.get_by_role("row", name="wait")).to_contain_text("497.900")


def test_a_call_that_is_not_over(page: Page, tmp_path: Path) -> None:
    """The drawing, the sentences and the table show that a caller is still waiting."""
    timeline = show(page, tmp_path, recording(open_end=True))
    click(page, timeline, 0.6, 2)
    expect(timeline.locator(".ros-details")).to_contain_text("was still waiting when the recording ended.")
    expect(
        timeline.get_by_text("800 ms. The call had not finished when the recording ended.")
    ).to_be_visible()
    timeline.get_by_text("The same as a table").click()
    expect(timeline.get_by_role("row", name="wait")).to_contain_text("not finished")


def test_nothing_was_recorded(page: Page, tmp_path: Path) -> None:
    """The panel says that an empty recording contains no events."""
    timeline = show(page, tmp_path, Recording(nodes=("/idle",), length=0.5))
    expect(timeline.get_by_text("The nodes did not communicate during the recording")).to_be_visible()
    expect(timeline.get_by_role("button")).to_have_count(0)
    picture(timeline, "timeline-empty")


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 560, 390])
def test_it_can_be_read(page: Page, tmp_path: Path, theme: str, width: int) -> None:
    """In both themes and on a narrow page, the texts have enough contrast and fit into the page."""
    page.set_viewport_size({"width": width, "height": 1000})
    failed = [
        Event("lookup", "/customer", "/nope", 0.8, 0.801, "master", "call 2", "MainThread"),
        Event("error", "/customer", "/nope", 0.801, 0.801, "", "call 2", "MainThread", "<b>unavailable</b>"),
    ]
    timeline = show(page, tmp_path, recording(*failed), theme)
    timeline.get_by_text("The same as a table").click()
    expect(timeline.get_by_role("row", name="error")).to_contain_text("<b>unavailable</b>")
    assert timeline.evaluate(FAINT) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    picture(timeline, f"timeline-{theme}-{width}")


def test_in_print(page: Page, tmp_path: Path) -> None:
    """In print, the drawing has a white background."""
    timeline = show(page, tmp_path, recording(), "dark")
    ground = "canvas => getComputedStyle(canvas.closest('section')).backgroundColor"
    assert drawing(timeline).evaluate(ground) != "rgb(255, 255, 255)"
    page.emulate_media(media="print")
    assert drawing(timeline).evaluate(ground) == "rgb(255, 255, 255)"
    x, y = spot(timeline, 0.45, 3)
    pixel = "(canvas, [x, y]) => [...canvas.getContext('2d').getImageData(x, y, 1, 1).data]"
    assert min(drawing(timeline).evaluate(pixel, [x, y])) > 150
    picture(timeline, "timeline-print")


def test_in_jupyterlab(lab: Lab, lab_page: Page) -> None:
    """A notebook shows a recording of a real call, and the keys work in the drawing."""
    cells = (
        "import rospy\nfrom course_pkg import Timeline, join\nfrom std_srvs.srv import Trigger\n"
        "node = join('recorder')",
        "served = rospy.Service('/answer', Trigger, lambda request: (True, 'here'))",
        "with node.record() as recording:\n    node.call('/answer', Trigger)",
        "Timeline(recording)",
    )
    with running_notebook(lab_page, lab, "timeline", *cells):
        timeline = panel(lab_page, "Timeline")
        expect(timeline.get_by_text("/recorder waited for /recorder on /answer")).to_be_visible()
        before = lab_page.locator(".jp-Cell.jp-mod-selected").evaluate_all(
            "cells => cells.map(cell => cell.innerText)"
        )
        drawing(timeline).focus()
        for key in ("ArrowDown", "+", "-", "0", "Enter", "d", "d"):
            lab_page.keyboard.press(key)
        expect(timeline.locator(".ros-details")).to_contain_text("/recorder asked the master")
        expect(lab_page.locator(".jp-CodeCell")).to_have_count(len(cells))
        after = lab_page.locator(".jp-Cell.jp-mod-selected").evaluate_all(
            "cells => cells.map(cell => cell.innerText)"
        )
        assert len(before) == len(after)
        expect(lab_page.locator(".jp-CodeCell .jp-InputPrompt").last).to_have_text(re.compile(r"\[4\]:"))
        picture(lab_page, "timeline-lab")
