"""Tests of the service panel in a real JupyterLab."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, Route, expect

from tests.browser.jupyter import Lab, run_all, running_notebook
from tests.browser.pages import READY, new_page, panel, picture
from tests.lab.commands import lab as running_course_lab

SERVER = """
import threading
import rospy
from course_pkg import ServicePanel, join
from course_pkg.srv import geometry

node = join("NODE")
release = threading.Event()

def measure(request):
    if request.length < 0:
        release.wait(30)
    area = request.length * request.width
    return round(area, 2), round(area * request.height, 2)

served = rospy.Service("/getGeometry", geometry, measure)
"""
SHOW = 'form = ServicePanel("/getGeometry")\nform'


def serving(page: Page, lab: Lab, node: str) -> AbstractContextManager[None]:
    """Run a notebook that offers a geometry service and shows a service panel."""
    return running_notebook(page, lab, node, SERVER.replace("NODE", node), SHOW)


@pytest.fixture(scope="module")
def shared(lab: Lab, context: BrowserContext) -> Iterator[Page]:
    """Open one notebook for all tests that do not change the cells or the kernel."""
    with new_page(context) as page, serving(page, lab, "shared"):
        yield page


@pytest.fixture
def form(shared: Page) -> Locator:
    """Run the shared notebook again to get a new panel."""
    shared.set_viewport_size({"width": 1280, "height": 1000})
    run_all(shared)
    return panel(shared)


@pytest.fixture
def own_form(lab: Lab, lab_page: Page, request: pytest.FixtureRequest) -> Iterator[Locator]:
    """Open a notebook for one test only."""
    with serving(lab_page, lab, request.node.name):
        yield panel(lab_page)


def fill(form: Locator, **values: str) -> None:
    """Type the given values into the fields of the form."""
    for name, text in values.items():
        field = form.get_by_label(name)
        field.fill(text)


def answer(form: Locator, name: str) -> Locator:
    """Return the value of a field of the response."""
    return form.get_by_role("row", name=name).get_by_role("cell").first


def run_cell(page: Page, code: str) -> None:
    """Append a cell with the given code, and run the cell."""
    page.locator(".jp-Notebook-footer").click()
    editor = page.locator(".jp-CodeCell .cm-content").last
    editor.click()
    page.keyboard.insert_text(code)
    page.keyboard.press("Control+Enter")


def test_fill_call_read(form: Locator) -> None:
    """A call shows the response and the equivalent terminal command."""
    fill(form, length="1.2", width="5.2", height="8.9")
    expect(form.get_by_label("Command for a terminal")).to_have_text(
        "rosservice call /getGeometry 1.2 5.2 8.9"
    )
    form.get_by_role("button", name="Call").click()
    expect(answer(form, "area")).to_have_text("6.24")
    expect(answer(form, "volume")).to_have_text("55.54")
    expect(form.get_by_text("Answered in")).to_be_visible()
    picture(form, "service-panel")


def test_a_wrong_field_is_marked_and_not_called(form: Locator) -> None:
    """A wrong field shows a note with the allowed values until the student corrects the field."""
    fill(form, length="1.2", width="five")
    form.get_by_role("button", name="Call").click()
    width = form.get_by_label("width")
    expect(width).to_have_attribute("aria-invalid", "true")
    expect(width).to_be_focused()
    allowed = "Give a float32 from -3.4e38 to 3.4e38, such as 1.5."
    expect(width).to_have_accessible_description(f"float32 'five' is not a number. {allowed}")
    expect(form.get_by_text("Not called: one field needs a correction.")).to_be_visible()
    picture(form, "service-panel-wrong-field")
    width.press("Control+a")
    width.press_sequentially("5.2")
    expect(width).not_to_have_attribute("aria-invalid", "true")
    expect(width).to_be_focused()
    width.press("Enter")
    expect(answer(form, "area")).to_have_text("6.24")


def test_an_error_does_not_move_the_button_during_a_press(form: Locator) -> None:
    """If an error message appears while the student presses the Call button, the button does not move."""
    fill(form, length="1.2", width="five")
    expect(form.get_by_text("These lines are for the last request without a mistake.")).to_be_visible()
    form.get_by_role("button", name="Call").click(delay=100)
    expect(form.get_by_text("Not called: one field needs a correction.")).to_be_visible()
    expect(form.get_by_label("width")).to_be_focused()


def test_a_hanging_call_can_be_cancelled(form: Locator) -> None:
    """Escape cancels a call that gets no response."""
    fill(form, length="-1", width="1", height="1")
    form.get_by_role("button", name="Call").click()
    expect(form.get_by_text("Calling…")).to_be_visible()
    expect(form.get_by_role("button", name="Call")).to_be_disabled()
    picture(form, "service-panel-calling")
    form.get_by_label("length").press("Escape")
    expect(form.get_by_text("Cancelled after")).to_be_visible()
    expect(form.get_by_text("but the server was not informed")).to_be_visible()
    expect(form.get_by_role("button", name="Call")).to_be_enabled()


def test_a_deadline_ends_a_hanging_call(form: Locator) -> None:
    """A call ends after the typed number of seconds, and the panel shows what to do next."""
    fill(form, length="-1")
    form.get_by_label("Wait at most").fill("0.3")
    form.get_by_role("button", name="Call").click()
    words = form.get_by_label("The error message of ROS")
    expect(words).to_contain_text("CallTimeout: service [/getGeometry]: no answer within 0.3 s")
    expect(form.get_by_text("Find out what the handler waits for")).to_be_visible()
    picture(form, "service-panel-timeout")


def test_everything_by_keyboard(form: Locator) -> None:
    """With the keyboard only, a student makes a call and repeats the call from the history."""
    page = form.page
    form.get_by_label("Service", exact=True).focus()
    for text in ("2", "3", "4"):
        page.keyboard.press("Tab")
        page.keyboard.press("Control+a")
        page.keyboard.type(text)
    page.keyboard.press("Tab")
    expect(form.get_by_role("button", name="Call")).to_be_focused()
    page.keyboard.press("Enter")
    expect(answer(form, "volume")).to_have_text("24.0")
    fill(form, length="9")
    history = form.get_by_text("History (1)")
    history.focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(form.get_by_label("length")).to_have_value("2")


def test_the_picker_follows_the_graph(own_form: Locator, lab_page: Page) -> None:
    """The list of services shows new services, and marks services that no longer exist."""
    form = own_form
    fill(form, length="7")
    hello = 'from std_srvs.srv import Trigger\nrospy.Service("/hello", Trigger, lambda _: (True, "hi"))'
    run_cell(lab_page, f"{hello}\nserved.shutdown()")
    expect(form.get_by_text("No service with this name is on the graph now.")).to_be_visible()
    expect(form.get_by_label("length")).to_have_value("7")
    picture(form, "service-panel-gone")
    form.get_by_label("Service", exact=True).select_option("/hello")
    expect(form.get_by_text("This request has no fields.")).to_be_visible()
    form.get_by_role("button", name="Call").click()
    expect(answer(form, "message")).to_have_text("hi")
    picture(form, "service-panel-no-fields")


def test_filling_from_python_shows_in_the_form(own_form: Locator, lab_page: Page) -> None:
    """Code in a cell fills in the form, and the page shows the values."""
    form = own_form
    run_cell(lab_page, "form.call(length=1.2, width=5.2, height=8.9).area")
    expect(form.get_by_label("length")).to_have_value("1.2")
    expect(answer(form, "area")).to_have_text("6.24")


def test_a_copy_button_copies(form: Locator) -> None:
    """The button copies the displayed command."""
    form.get_by_role("button", name="Copy the command").click()
    expect(form.get_by_text("Copied")).to_be_visible()
    assert form.page.evaluate("navigator.clipboard.readText()") == "rosservice call /getGeometry 0.0 0.0 0.0"


def test_the_end_of_the_kernel_is_reported(own_form: Locator, lab_page: Page) -> None:
    """When the kernel is shut down, the panel shows a message and makes no more calls."""
    form = own_form
    form.get_by_role("button", name="Call").click()
    expect(answer(form, "area")).to_have_text("0.0")
    lab_page.get_by_role("menuitem", name="Kernel", exact=True).click()
    lab_page.get_by_role("menuitem", name="Shut Down Kernel", exact=True).click()
    expect(form.get_by_text("No kernel answers: this is a saved panel.")).to_be_visible()
    expect(form.get_by_role("button", name="Call")).to_be_disabled()
    expect(answer(form, "area")).to_have_text("0.0")
    picture(form, "service-panel-no-kernel")


@pytest.mark.parametrize("width", [1280, 560])
def test_nothing_is_wider_than_the_page(form: Locator, width: int) -> None:
    """In a wide and in a narrow window, the panel fits into the window."""
    form.page.set_viewport_size({"width": width, "height": 1000})
    fill(form, length="1.2", width="5.2", height="8.9")
    # The page has its final layout when the commands contain the typed values.
    expect(form.get_by_role("region", name="The same call")).to_contain_text("8.9")
    before = form.get_by_role("button", name="Call").bounding_box()
    form.get_by_role("button", name="Call").click()
    expect(answer(form, "area")).to_have_text("6.24")
    assert form.get_by_role("button", name="Call").bounding_box() == before
    too_wide = form.evaluate(
        "root => [...root.querySelectorAll('*')]"
        ".filter((each) => each.getBoundingClientRect().right > root.getBoundingClientRect().right + 1)"
        ".filter((each) => !each.closest('pre, .ros-answer, .ros-hidden')).map((each) => each.outerHTML)"
    )
    assert too_wide == []
    picture(form, f"service-panel-{width}")


@pytest.mark.timeout(300)
def test_a_reader_runs_chapter_05_and_calls_the_server_from_the_form(page: Page) -> None:
    """All cells of chapter 05 run, and the panel's call shows the area and the volume."""
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.route("**/api/contents/**", _write_nothing)
    with running_course_lab("solutions/05_write_a_server.ipynb") as (_, address):
        page.goto(address, timeout=READY)
        expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle", timeout=READY)
        picture(page, "chapter-05-opened")
        assert [words for words in said if "failed to activate" in words] == []
        page.get_by_role("menuitem", name="Run", exact=True).click()
        page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        form = panel(page)
        form.scroll_into_view_if_needed()
        expect(page.get_by_text("05.1 passed: 2 of 2 points").first).to_be_visible(timeout=READY)
        for name, value in {"length": "1.2", "width": "5.2", "height": "8.9"}.items():
            form.get_by_label(name).fill(value)
        # The timeout is long because the click waits until all cells have run.
        form.get_by_role("button", name="Call", exact=True).click(timeout=READY)
        expect(form.get_by_role("cell", name="55.536", exact=True)).to_be_visible(timeout=READY)
        expect(form.get_by_role("cell", name="6.2400002", exact=True)).to_be_visible()
        picture(page, "chapter-05-answered")


def _write_nothing(route: Route) -> None:
    """Prevent the page from writing to the solution in the checkout."""
    if route.request.method == "PUT":
        route.abort()
    else:
        route.continue_()
