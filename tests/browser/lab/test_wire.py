"""Tests of the wire view on a saved page and in JupyterLab."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.panels import WireView
from course_pkg.types import compile_service
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import FAINT, panel, picture, save

pytestmark = pytest.mark.usefixtures("server")

SIDES = {"length": 1.2, "width": 5.2, "height": 8.9}
WHOLE = "int32 length\nint32 width\nint32 height\n---\nfloat32 area\nfloat32 volume"


def show(page: Page, folder: Path, view: WireView, theme: str = "light") -> Locator:
    """Open a saved page with a wire view."""
    page.goto(save(view, folder / "page.html", theme))
    return panel(page, "Wire view")


def pieces(wire: Locator, name: str) -> Locator:
    """Return the table row of a field."""
    return wire.locator(".ros-sides tbody tr").filter(
        has=wire.page.locator("td:nth-child(3)", has_text=re.compile(f"^{name}$"))
    )


def lit(wire: Locator) -> str:
    """Return the highlighted bytes."""
    return " ".join(wire.locator(".ros-hex .ros-on").all_inner_texts())


def test_a_field_and_its_bytes_belong_together(page: Page, tmp_path: Path) -> None:
    """When the pointer is on a value, the view highlights the value's bytes."""
    wire = show(page, tmp_path, WireView("/getGeometry", **SIDES))
    expect(wire.locator("[aria-current]")).to_contain_text("Request")
    pieces(wire, "width").hover()
    assert lit(wire) == "66 66 a6 40"
    wire.locator(".ros-hex .ros-byte").last.hover()
    expect(pieces(wire, "height")).to_have_class(re.compile("ros-on"))
    assert lit(wire) == "66 66 0e 41"
    wire.locator("h3").hover()
    assert lit(wire) == ""
    wire.locator(".ros-hex .ros-byte").nth(4).click()
    expect(pieces(wire, "length")).to_be_focused()
    assert lit(wire) == "9a 99 99 3f"


def test_the_keyboard_reaches_every_step_and_piece(page: Page, tmp_path: Path) -> None:
    """The arrow keys select each step and each field."""
    wire = show(page, tmp_path, WireView("/getGeometry", **SIDES))
    wire.locator("[aria-current]").focus()
    for title in ("Response", "The connection is closed"):
        page.keyboard.press("ArrowDown")
        expect(wire.locator(":focus")).to_contain_text(title)
    page.keyboard.press("Home")
    expect(wire.locator(".ros-step")).to_contain_text("<methodName>lookupService</methodName>")
    expect(wire.get_by_label("The previous step")).to_be_disabled()
    wire.get_by_label("Step of the call").fill("4")
    expect(wire.locator(".ros-step h4")).to_have_text("Connection header of the client")
    wire.locator(".ros-sides tbody tr").first.focus()
    page.keyboard.press("End")
    page.keyboard.press("ArrowUp")
    expect(wire.locator(":focus")).to_contain_text("length of the next field")
    assert wire.locator("tbody tr[tabindex='0']").count() == 1


def test_the_whole_exchange_is_a_table(page: Page, tmp_path: Path) -> None:
    """A table in the view lists all steps of the call."""
    wire = show(page, tmp_path, WireView("/getGeometry", **SIDES))
    wire.get_by_text("The whole exchange as a table").click()
    table = wire.get_by_label("The whole exchange")
    expect(table.get_by_role("row").filter(has_text="9a 99 99 3f")).to_contain_text("0x0004")
    expect(table).to_contain_text("30446f62d79d69140d848ff84559306a")


def test_the_cause_of_a_failure_is_shown(page: Page, tmp_path: Path) -> None:
    """If a call is refused, the view shows the error message or the server's header."""
    wire = show(page, tmp_path, WireView("/getGeometry", **{**SIDES, "length": -1.0}))
    expect(wire.get_by_text(re.compile("The call failed"))).to_be_visible()
    wire.get_by_role("button", name=re.compile("Error$")).click()
    expect(pieces(wire, "ok")).to_contain_text("the call failed")
    expect(pieces(wire, "error")).to_contain_text("length is -1")
    picture(page, "wire-refused")
    other = compile_service("course_pkg/geometry", WHOLE)
    wire = show(page, tmp_path, WireView("/getGeometry", other, length=1, width=5, height=8))
    wire.get_by_role("button", name=re.compile("refuses the connection")).click()
    expect(pieces(wire, "error")).to_contain_text("md5sums do not match")
    assert wire.get_by_role("button", name=re.compile("Request")).count() == 0
    picture(page, "wire-md5")


def test_what_is_long_is_folded(page: Page, tmp_path: Path) -> None:
    """For a long field, the view shows only the beginning of the value and its length."""
    wire = show(page, tmp_path, WireView("/nobody"))
    expect(wire.locator("[aria-current]")).to_contain_text("No node provides the service")
    expect(wire.get_by_text("unavailable")).to_be_visible()
    headers = {"long": "x" * 3000}
    wire = show(page, tmp_path, WireView("/getGeometry", None, headers, **SIDES))
    wire.get_by_role("button", name=re.compile("header of the client")).click()
    expect(wire.locator(".ros-fold")).to_contain_text("more bytes, folded")
    assert wire.locator(".ros-byte").count() < 600


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1000, 560])
def test_it_can_be_read(page: Page, tmp_path: Path, theme: str, width: int) -> None:
    """Each text has a contrast of at least 4.5 : 1 in both themes, and the view fits into the window."""
    page.set_viewport_size({"width": width, "height": 1100})
    wire = show(page, tmp_path, WireView("/getGeometry", **SIDES), theme)
    for step in ("header of the server", "Request", "Response"):
        wire.get_by_role("button", name=re.compile(step)).click()
        wire.locator(".ros-sides tbody tr").last.hover()
        assert wire.evaluate(FAINT) == []
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        picture(page, f"wire-{step.split()[-1].lower()}-{theme}-{width}")


def test_it_runs_in_jupyterlab(lab_page: Page, lab: Lab) -> None:
    """In a notebook, the arrow keys change the selection only within the panel."""
    cells = (
        "from course_pkg import WireView, join\nnode = join('wire_view')\n"
        "server = node.run('course_pkg', 'server')\nserver.wait_for_service('/getGeometry', timeout=20)",
        "WireView('/getGeometry', length=1.2, width=5.2, height=8.9)",
    )
    with running_notebook(lab_page, lab, "wire", *cells):
        wire = panel(lab_page, "Wire view")
        wire.locator("[aria-current]").focus()
        lab_page.keyboard.press("ArrowDown")
        expect(wire.locator(".ros-step h4")).to_have_text("Response")
        picture(lab_page, "wire-lab")
