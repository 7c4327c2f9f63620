"""Tests of the type browser in a real browser."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from course_pkg.panels import TypeBrowser
from course_pkg.panels.types.model import packages
from course_pkg.ros import PrivateMaster
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import FAINT, panel, picture, save
from tests.types.conftest import package

SERVE = """
from course_pkg import TypeBrowser, join
from std_srvs.srv import SetBool
import rospy
node = join("types_test")
switch = rospy.Service("/switch", SetBool, lambda request: (True, ""))
"""


def options(browser: Locator) -> Locator:
    """Return the displayed types."""
    return browser.get_by_role("option")


def test_search_open_and_copy_by_keyboard(lab: Lab, lab_page: Page) -> None:
    """The student searches, opens and copies a type with the keyboard only."""
    with running_notebook(lab_page, lab, "types", SERVE, "TypeBrowser()"):
        browser = panel(lab_page, "Type browser")
        expect(browser.get_by_text("Pick a type from the list")).to_be_visible()
        browser.get_by_label("Find a type").fill("std_srvs")
        expect(options(browser)).to_have_count(3)
        lab_page.keyboard.press("ArrowDown")
        lab_page.keyboard.press("Enter")
        about = browser.get_by_role("region", name="The open type")
        expect(about).to_contain_text("std_srvs/SetBool")
        expect(about).to_contain_text("/switch served by /types_test")
        expect(browser.get_by_role("option", name="SetBool")).to_contain_text("in use")
        about.get_by_role("button", name="Copy import, in Python").click()
        assert lab_page.evaluate("navigator.clipboard.readText()") == "from std_srvs.srv import SetBool"
        picture(browser, "type-browser")
        browser.get_by_label("Find a type").fill("pose")
        expect(browser.get_by_role("status").last).to_contain_text("message types")
        browser.get_by_label("messages").check()
        browser.get_by_role("option", name="PoseStamped").click()
        inner = about.get_by_text("orientation")
        expect(inner).to_be_hidden()
        about.get_by_text("geometry_msgs/Pose", exact=True).click()
        expect(inner).to_be_visible()
        picture(browser, "type-browser-message")


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 560])
def test_a_saved_browser_keeps_what_was_open(
    master: PrivateMaster, page: Page, tmp_path: Path, theme: str, width: int
) -> None:
    """On a saved page, the reader can search the list, but cannot open other types."""
    assert master.uri
    page.set_viewport_size({"width": width, "height": 1000})
    page.goto(save(TypeBrowser("sensor_msgs/SetCameraInfo"), tmp_path / "page.html", theme))
    browser = panel(page, "Type browser")
    expect(browser.get_by_text("No kernel answers: this is a saved panel.")).to_be_visible()
    browser.get_by_label("Find a type").fill("bool")
    expect(options(browser)).to_have_count(1)
    browser.get_by_role("option", name="SetBool").click(force=True)
    about = browser.get_by_role("region", name="The open type")
    expect(about).to_contain_text("sensor_msgs/SetCameraInfo")
    about.locator("summary").first.click()
    about.get_by_text("The text of SetCameraInfo.srv").click()
    assert browser.evaluate(FAINT) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    picture(page, f"type-browser-saved-{theme}-{width}")


def test_a_broken_file_is_shown_with_its_line(
    master: PrivateMaster, page: Page, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If a definition is invalid, the error message contains the file, the line and the column."""
    assert master.uri
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    package(tmp_path, "bad_pkg", Slip_srv="float64 ok\nfloat64 side;\n---\n")
    page.goto(save(TypeBrowser("bad_pkg/Slip"), tmp_path / "page.html"))
    browser = panel(page, "Type browser")
    expect(browser.get_by_label("What is wrong")).to_contain_text("bad_pkg/srv/Slip.srv, line 2, column 9")
    assert browser.evaluate(FAINT) == []
    picture(page, "type-browser-broken")


def test_a_thousand_types_are_searched_at_once(master: PrivateMaster, page: Page, tmp_path: Path) -> None:
    """With 1000 types, the panel shows the right counts, and the search finds only the matching types."""
    assert master.uri
    widget = TypeBrowser()
    names = tuple(f"package_{number // 20}/Type{number}" for number in range(1000))
    widget.publish(packages=packages((names, names)))
    page.goto(save(widget, tmp_path / "page.html"))
    browser = panel(page, "Type browser")
    expect(browser.get_by_role("status").last).to_have_text("1000 types in 50 packages")
    browser.get_by_label("Find a type").fill("package_7 type14")
    expect(options(browser)).to_have_count(10)
    expect(browser.get_by_role("status").last).to_have_text("10 types in 1 package; also 10 message types")
    browser.get_by_label("Find a type").fill("nothing of this name")
    expect(browser.get_by_role("status").last).to_have_text("No type found")
    picture(page, "type-browser-nothing")
