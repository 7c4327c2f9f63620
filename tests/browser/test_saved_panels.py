"""Panels on a page without a kernel: drawn from their saved state, by a host of a few lines."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.graph import NodeProcess, PrivateMaster
from course_pkg.panels import GraphPanel, ServicePanel
from course_pkg.panels.panel import Panel
from course_pkg.panels.prediction.store import PredictionStore
from course_pkg.panels.prediction.view import Prediction
from tests.browser.jupyter import panel, picture

HOST = Path(__file__).with_name("host.html").read_text()


@pytest.fixture(scope="module", autouse=True)
def server(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the course's geometry server on the master."""
    assert master.uri
    server = NodeProcess.rosrun("course_pkg", "server")
    server.wait_for_service("/getGeometry", timeout=20)
    yield server
    server.stop()


def save(widget: Panel, path: Path, theme: str = "light") -> str:
    """Write a page with the widget's state, and give its address."""
    state = {
        name: value
        for name, value in widget.get_state().items()
        if isinstance(value, str | list | dict | bool)
    }
    text = json.dumps(state).replace("</", "<\\/")
    path.write_text(HOST.replace("THEME", theme).replace("CSS", state["_css"]).replace("STATE", text))
    widget.close()
    return path.as_uri()


def answer(form: Locator, name: str) -> Locator:
    """Find the value of a field of the response."""
    return form.get_by_role("row", name=name).get_by_role("cell").first


def test_a_saved_panel_says_that_it_is_one(page: Page, tmp_path: Path) -> None:
    """The last answer is there, Call is out of use, and a sentence says why."""
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
def test_a_recording_answers_for_the_kernel(page: Page, tmp_path: Path, theme: str) -> None:
    """A recorded request is answered however its numbers are typed, any other is said not to be recorded."""
    widget = ServicePanel("/getGeometry")
    widget.record(
        [{"length": 1.0, "width": 2.0, "height": 3.0}, {"length": 4.0, "width": 5.0, "height": 6.0}]
    )
    page.set_viewport_size({"width": 390, "height": 1200})
    page.goto(save(widget, tmp_path / "page.html", theme))
    form = panel(page)
    expect(form.get_by_text("The answers here were recorded from a real server")).to_be_visible()
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


def test_a_saved_picture_of_the_graph_can_be_asked(page: Page, tmp_path: Path) -> None:
    """A click still tells what a shape is, and the page says that the picture is a saved one."""
    page.goto(save(GraphPanel(), tmp_path / "page.html"))
    graph = panel(page, "Graph panel")
    expect(graph.get_by_text("this picture was saved")).to_be_visible()
    graph.get_by_role("button", name="service /getGeometry").click()
    expect(graph.locator(".ros-details")).to_contain_text("course_pkg/geometry")


def test_a_saved_question_is_out_of_use(page: Page, tmp_path: Path) -> None:
    """Nothing keeps an answer without a kernel, so none can be given."""
    store = PredictionStore(tmp_path / "predictions.json")
    page.goto(save(Prediction("05.x", "What?", ["this", "that"], store=store), tmp_path / "page.html"))
    expect(page.get_by_text("run the notebook to keep a prediction")).to_be_visible()
    expect(page.get_by_label("this")).to_be_disabled()
