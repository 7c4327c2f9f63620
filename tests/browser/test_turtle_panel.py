"""Tests of the turtle panel in a real JupyterLab, and as a recording on a saved page."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.panels.turtles.pen import USUAL, Observation
from course_pkg.panels.turtles.recording import TurtleRecording
from course_pkg.panels.turtles.view import TurtlePanel
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import panel, picture, save

SETUP = """
from course_pkg import TurtlePanel, join
from std_srvs.srv import Empty
from turtlesim.srv import Kill, Spawn, TeleportAbsolute
node = join("turtles_test")
simulator = node.run("turtlesim", "turtlesim_node")
simulator.wait_for_service("/spawn", timeout=20)
"""
LATER = """
import threading
def later():
    node.call("/spawn", Spawn, 2, 3, 0, "MyTurtle")
    node.call("/turtle1/teleport_absolute", TeleportAbsolute, 9, 9, 0)
threading.Timer(1, later).start()
"""


def seek(turtles: Locator, part: float) -> None:
    """Move the recording's slider to a position from 0 (start) to 1 (end)."""
    turtles.get_by_label("Moment of the recording").evaluate(
        "(handle, part) => { handle.value = handle.max * part; handle.dispatchEvent(new Event('input')) }",
        part,
    )


def cells(turtles: Locator, name: str) -> list[str]:
    """Return the cells of a turtle's row in the table."""
    return turtles.get_by_role("row", name=name).get_by_role("cell").all_inner_texts()


def recorded() -> TurtleRecording:
    """Return a recording of 5 s.

    In the recording, one turtle moves in a circle, and a second turtle appears after 3 s.
    """
    recording = TurtleRecording()
    for number in range(100):
        angle = number / 100 * 2 * math.pi
        x, y = 5.5 + 3 * math.cos(angle), 5.5 + 3 * math.sin(angle)
        recording.see(number * 50, "turtle1", Observation(x, y, angle - math.pi, 1.0, USUAL))
        if number >= 60:
            recording.see(number * 50, "MyTurtle", Observation(1.0, 1.0, 0.0, 0.0, (69, 86, 255)))
    return recording


def test_the_panel_follows_the_turtles(lab: Lab, lab_page: Page) -> None:
    """The table shows a new turtle, and a turtle's new position."""
    with running_notebook(lab_page, lab, "turtles", SETUP, "TurtlePanel()", LATER):
        turtles = panel(lab_page, "Turtle panel")
        expect(turtles.get_by_role("row", name="MyTurtle")).to_be_visible()
        expect(turtles.get_by_role("row", name="turtle1").get_by_role("cell").first).to_have_text("9.00")
        assert cells(turtles, "MyTurtle") == ["2.00", "3.00", "0.00"]
        expect(turtles.get_by_role("img")).to_have_attribute(
            "aria-label", "The turtles' world: MyTurtle at 2.0, 3.0; turtle1 at 9.0, 9.0"
        )
        picture(turtles, "turtle-panel-live")
        seek(turtles, 0.0)
        expect(turtles.get_by_role("row", name="MyTurtle")).to_have_count(0)
        turtles.get_by_role("button", name="Go live").click()
        expect(turtles.get_by_role("row", name="MyTurtle")).to_be_visible()


def test_without_a_simulator(lab: Lab, lab_page: Page) -> None:
    """Without a simulator, the panel shows the command that starts a simulator."""
    with running_notebook(
        lab_page, lab, "no_turtles", SETUP.replace("simulator", "# simulator"), "TurtlePanel()"
    ):
        turtles = panel(lab_page, "Turtle panel")
        expect(turtles.get_by_text("No turtle is on the graph. Start turtlesim_node")).to_be_visible()
        expect(turtles.get_by_role("button", name="Play")).to_be_disabled()
        picture(turtles, "turtle-panel-empty")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_recording_is_played_without_a_kernel(page: Page, tmp_path: Path, theme: str) -> None:
    """A saved page first shows the end of the recording, and the reader can play the recording."""
    widget = TurtlePanel()
    widget.publish(recorded=recorded().state())
    page.set_viewport_size({"width": 390, "height": 900})
    page.goto(save(widget, tmp_path / "page.html", theme))
    turtles = panel(page, "Turtle panel")
    expect(turtles.get_by_text("No kernel answers: this is a recording.")).to_be_visible()
    expect(turtles.get_by_role("row", name="MyTurtle")).to_be_visible()
    seek(turtles, 0.5)
    expect(turtles.get_by_role("row", name="MyTurtle")).to_have_count(0)
    assert abs(float(cells(turtles, "turtle1")[0]) - 2.5) < 0.3
    seek(turtles, 0.95)
    turtles.get_by_role("button", name="Play").click()
    expect(turtles.get_by_text("5.0 of 5.0 s")).to_be_visible()
    expect(turtles.get_by_role("button", name="Play")).to_be_enabled()
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    picture(page, f"turtle-panel-recorded-{theme}")


def test_the_trail_is_on_the_paper(page: Page, tmp_path: Path) -> None:
    """The drawn line is exactly the path of the turtle."""
    widget = TurtlePanel()
    widget.publish(recorded=recorded().state())
    page.goto(save(widget, tmp_path / "page.html"))
    turtles = panel(page, "Turtle panel")
    seek(turtles, 0.5)
    colours = turtles.locator("canvas").evaluate(
        """(canvas) => [[5.5, 8.5], [5.5, 2.5]].map(([x, y]) => {
            const scale = canvas.width / 500 * 499 / 11.088889;
            const pen = canvas.getContext("2d");
            const pixel = pen.getImageData(x * scale, canvas.height - y * scale, 1, 1).data;
            return [...pixel.slice(0, 3)].join();
        })"""
    )
    assert colours == ["179,184,255", "69,86,255"]
