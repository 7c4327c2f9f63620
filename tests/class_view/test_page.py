"""Tests of the page in a browser: the page updates without a reload, hides names, and is accessible."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.pages import Colours, page_at, picture
from tests.class_view.classes import NASTY, TEACHER, result, send, serving, tokens_in
from tests.site.test_pages import AXE, violations
from tests.support import usual

PARTS = ("05.1", "05.2", "05.3", "05.4")
HINTS = ("That is width + length. An area is a product.", f"Return a response. {NASTY}")


@contextmanager
def opened(
    browser: Browser, url: str, width: int = 1280, colours: Colours = "light"
) -> Iterator[tuple[Page, list[str]]]:
    """Open the page with the token in the URL, and wait until the page shows its data."""
    with page_at(browser, f"{url}/?token={TEACHER}", width, colours) as (page, words):
        expect(page.get_by_role("status")).to_have_text("Live")
        yield page, words


def fill(url: str, folder: Path) -> None:
    """Send the results of a class that works on chapter 05."""
    began = time.time() - 3000
    for number, token in enumerate(tokens_in(folder).values()):
        for place, part in enumerate(PARTS[: number % 5]):
            stuck = (number + place) % 3 == 0
            tries = [
                result(f"{place}-{each}", part, hint=HINTS[number % 2], time=began + 40 * number + each)
                for each in range(number % 4 + stuck)
            ]
            passed = [] if stuck else [result(part.replace(".", "-"), part, "passed")]
            assert send(url, token, *tries, *passed)[0] == 200


def test_the_page_follows_the_class(browser: Browser, tmp_path: Path) -> None:
    """A new result appears on the page without a reload.

    A teacher can hide the names with the keyboard, and the names are still hidden after a reload.
    """
    with serving(tmp_path) as url, opened(browser, url) as (page, words):
        token = tokens_in(tmp_path)["s01"]
        expect(page.get_by_text("There are no results for this selection yet.")).to_be_visible()
        send(url, token, result("r1", hint=HINTS[1], time=time.time() - 700))
        expect(page.locator("#stuck li")).to_contain_text(["11 min"])
        expect(page.locator("#hints li")).to_contain_text([HINTS[1]])
        row = page.get_by_role("row", name="Student 01")
        expect(row).to_contain_text("not yet, 1 try")
        page.get_by_role("button", name="Hide names").focus()
        page.keyboard.press("Enter")
        expect(page.locator("body")).not_to_contain_text("Student 01")
        page.reload()
        expect(page.locator("#stuck li")).to_contain_text(["11 min"])
        expect(page.locator("body")).not_to_contain_text("Student 01")
        page.get_by_role("button", name="Hide names").press("Space")
        send(url, token, result("r2", verdict="passed"))
        expect(page.get_by_text("No student is stuck.")).to_be_visible()
        expect(row.locator("td.passed")).to_have_count(1)
        page.get_by_label("Chapter").select_option("06")
        expect(row.locator("td.passed")).to_have_count(0)
        assert words == []


@pytest.mark.parametrize("colours", usual(1, {"light": "light", "dark": "dark"}))
def test_the_page_is_accessible_and_fits(browser: Browser, tmp_path: Path, colours: Colours) -> None:
    """axe-core finds no problem, the page fits into the window, and scripts in a result do not run.

    The test opens the page before any result was sent, and after a class has sent results.
    """
    with serving(tmp_path, 8) as url:
        for state in ("empty", "class"):
            for width in (1280, 390):
                with opened(browser, url, width, colours) as (page, words):
                    assert page.evaluate("document.documentElement.scrollWidth") <= width
                    picture(page, f"class-{state}-{width}-{colours}")
                    page.evaluate(AXE)
                    assert violations(page) == []
                    assert words == []
            fill(url, tmp_path)
