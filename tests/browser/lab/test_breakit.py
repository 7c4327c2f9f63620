"""Tests of the panel "Break it" in a real JupyterLab, and on a saved page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, expect

from course_pkg.faults import named
from course_pkg.faults.fault import Fault
from course_pkg.panels import BreakIt
from course_pkg.panels.breakit.cases import CaseStore, cases
from course_pkg.ros import MasterClient, PrivateMaster
from tests.browser.jupyter import Lab, run_all, running_notebook
from tests.browser.pages import new_page, panel, picture, save
from tests.support import eventually

SET_UP = "from course_pkg import BreakIt, join\nnode = join('NODE')\nnode.master"
SHOW = "lab = BreakIt('stale', 'stopped', 'returns_none')\nlab"
LABEL = "Break it"


def number(name: str) -> int:
    """Return the number of the panel's case that has the given fault; each case has one fault."""
    return next(case.number for case in cases() if case.fault.name == name)


def begin(lab: Locator, name: str) -> None:
    """Open the case that has the given fault, and wait for its symptom."""
    lab.get_by_role("button", name=f"Case {number(name)},").click()
    expect(lab.get_by_text(f"Case {number(name)}. ")).to_be_visible()
    expect(lab.get_by_text("The fault is active.")).to_be_visible()


def shown(text: str) -> str:
    """Remove the backticks of Markdown from a text."""
    return text.replace("`", "")


def answer(lab: Locator, fault: Fault) -> None:
    """Select the right diagnosis and the right remedy of a fault, and click Check."""
    lab.get_by_label(shown(fault.diagnosis)).check()
    lab.get_by_label(shown(fault.remedy)).check()
    lab.get_by_role("button", name="Check").click()


@pytest.fixture(scope="module")
def shared(lab: Lab, context: BrowserContext) -> Iterator[Page]:
    """Open one notebook for the tests of this module."""
    with (
        new_page(context) as page,
        running_notebook(page, lab, "breakit", SET_UP.replace("NODE", "breakit"), SHOW),
    ):
        yield page


@pytest.fixture
def form(shared: Page) -> Locator:
    """Run all cells again, so that the notebook has a new panel."""
    shared.set_viewport_size({"width": 1280, "height": 1600})
    run_all(shared)
    return panel(shared, LABEL)


def test_a_case_is_opened_examined_and_answered(form: Locator) -> None:
    """At first, the panel shows only the symptom. After each answer, the panel shows a reason."""
    picture(form, "breakit-opened")
    begin(form, "stale")
    expect(form.get_by_label("What it printed")).to_contain_text("[Errno 111] Connection refused")
    expect(form).not_to_contain_text(named("stale").reason[:40])
    picture(form, "breakit-symptom")
    form.get_by_role("button", name="rosservice list").click()
    expect(form.locator(".ros-looks").get_by_label("What it printed")).to_contain_text("/lab/door")
    wrong = next(case for case in cases() if case.fault.name == "stale").diagnoses
    other = next(text for text in wrong if text != named("stale").diagnosis)
    form.get_by_label(shown(other)).check()
    form.get_by_label(shown(named("stale").remedy)).check()
    form.get_by_role("button", name="Check").click()
    expect(form.get_by_text("Your diagnosis is wrong: the graph has a different fault.")).to_be_visible()
    expect(form.get_by_text("The fault that you chose would have different symptoms")).to_be_visible()
    picture(form, "breakit-wrong")
    answer(form, named("stale"))
    expect(form.get_by_text("Right.", exact=True)).to_be_visible()
    expect(form.get_by_text("This topic is taught in chapter 12")).to_be_visible()
    expect(form.get_by_text("1 of 3 solved, 0 at the first try")).to_be_visible()
    picture(form, "breakit-right")


def test_by_keyboard_alone(form: Locator, shared: Page) -> None:
    """A student opens and answers a case with the keyboard only."""
    form.get_by_role("button", name=re.compile("^Case")).first.focus()
    at = sorted(number(name) for name in ("stale", "stopped", "returns_none"))
    for _ in range(at.index(number("returns_none"))):
        shared.keyboard.press("ArrowRight")
    expect(form.get_by_role("button", name=f"Case {number('returns_none')},")).to_be_focused()
    shared.keyboard.press("Enter")
    expect(form.get_by_text("The fault is active.")).to_be_visible()
    form.get_by_label(shown(named("returns_none").diagnosis)).focus()
    shared.keyboard.press("Space")
    form.get_by_label(shown(named("returns_none").remedy)).focus()
    shared.keyboard.press("Space")
    form.get_by_role("button", name="Check").focus()
    shared.keyboard.press("Enter")
    expect(form.get_by_text("Right.", exact=True)).to_be_visible()
    form.get_by_role("button", name="Undo the fault").focus()
    shared.keyboard.press("Enter")
    expect(form.get_by_text("The fault was removed.")).to_be_visible()


def test_a_hanging_call_is_described(form: Locator) -> None:
    """If a call gets no response within 2 s, the panel says that the call hangs."""
    begin(form, "stopped")
    expect(form.get_by_text("No answer within 2 s; still waiting.")).to_be_visible()
    form.page.set_viewport_size({"width": 560, "height": 1600})
    form.get_by_role("button", name="rosnode ping").click()
    expect(form.locator(".ros-looks li")).to_have_count(1)
    picture(form, "breakit-560")
    assert form.evaluate("element => element.scrollWidth <= element.clientWidth + 1")


def test_leaving_the_page_undoes_the_fault(lab: Lab, context: BrowserContext) -> None:
    """When the student closes the page, the panel removes its fault and its nodes."""
    with (
        new_page(context) as page,
        running_notebook(page, lab, "leaving", SET_UP.replace("NODE", "leaving"), SHOW),
    ):
        shown = page.locator(".jp-OutputArea-output", has_text="http://localhost").first.inner_text()
        master = MasterClient(shown.strip().strip("'"))
        # The graph may already contain the nodes of a fault that another panel has caused.
        before = master.system_state().nodes
        begin(panel(page, LABEL), "stale")
        assert master.system_state().nodes != before
        page.goto("about:blank")
        eventually(lambda: master.system_state().nodes == before)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_saved_lab_shows_the_last_case(
    page: Page, tmp_path: Path, master: PrivateMaster, theme: str
) -> None:
    """A saved page shows the last case that the student opened, and all buttons are disabled."""
    assert master.uri
    widget = BreakIt("stopped", "returns_none", store=CaseStore(tmp_path / "cases.json"))
    widget._model.open(number("returns_none"))
    eventually(lambda: widget.case.get("phase") == "ready")
    widget._model.answer(named("returns_none").diagnosis, named("returns_none").remedy)
    page.set_viewport_size({"width": 560, "height": 1400})
    page.goto(save(widget, tmp_path / "page.html", theme))
    form = panel(page, LABEL)
    expect(
        form.get_by_text("No kernel answers: this is a saved panel. It shows the last state of the last case")
    ).to_be_visible()
    expect(form.get_by_label("What it printed")).to_contain_text("service handler returned None")
    expect(form.get_by_text("Right.", exact=True)).to_be_visible()
    expect(form.get_by_role("button", name="Undo the fault")).to_be_disabled()
    assert page.evaluate("document.documentElement.scrollWidth") <= 560
    picture(page, f"breakit-saved-{theme}")
