"""Tests of the review page in a browser."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from course_pkg.grading.review.items import Wanted
from course_pkg.grading.review.overrides import FILE
from tests.browser.pages import Colours, page_at, picture
from tests.grading.review.classes import TOKEN, serving, write_class
from tests.site.test_pages import AXE, violations
from tests.support import eventually, usual


@contextmanager
def opened(
    browser: Browser, url: str, width: int = 1280, colours: Colours = "light"
) -> Iterator[tuple[Page, list[str]]]:
    """Open the page with the token in the URL, and wait until the page shows its data."""
    with page_at(browser, f"{url}/?token={TOKEN}", width, colours) as (page, words):
        expect(page.locator("body[data-shown='0']")).to_be_visible()
        yield page, words


def _rows(out: Path) -> dict[tuple[str, str], tuple[str, str]]:
    with (out / FILE).open(encoding="utf-8-sig", newline="") as file:
        return {
            (each["student"], each["part"]): (each["points"], each["comment"])
            for each in csv.DictReader(file)
        }


def _saved(page: Page) -> None:
    expect(page.get_by_role("status")).to_contain_text("Saved")


def test_a_review_with_the_keyboard_only(browser: Browser, tmp_path: Path) -> None:
    """An instructor reviews several answers with the keyboard only."""
    out = write_class(tmp_path)
    with serving(out) as url, opened(browser, url) as (page, words):
        keys, answer = page.keyboard, page.get_by_role("article")
        expect(answer).to_contain_text("=evil")
        keys.press("n")
        expect(answer.get_by_role("heading", name="s01")).to_be_visible()
        for key in ("1", ",", "5", "Enter"):
            keys.press(key)
        _saved(page)
        assert _rows(out) == {("s01", "Part 05.1"): ("1.5", "")}
        keys.press("Escape")
        keys.press("c")
        keys.type("Name the rate.\nn p u x")
        keys.press("Control+Enter")
        both = ("1.5", "Name the rate.\nn p u x")
        eventually(lambda: _rows(out) == {("s01", "Part 05.1"): both})
        expect(page.get_by_role("button", name="Apply to 1 identical answer, too")).to_be_visible()
        keys.press("a")
        eventually(lambda: _rows(out) == {("s01", "Part 05.1"): both, ("s02", "Part 05.1"): both})
        keys.press("u")
        eventually(lambda: _rows(out) == {("s01", "Part 05.1"): both})
        keys.press("N")
        expect(page.locator("#part")).to_have_value("05.2")
        keys.press("g")
        keys.press("2")
        # A letter key is a keyboard command, even while the cursor is in the field for points.
        keys.press("n")
        expect(answer.get_by_role("heading", name="s02")).to_be_visible()
        expect(page.locator("#points")).to_be_focused()
        eventually(lambda: _rows(out).get(("s01", "Part 05.2")) == ("2", ""))
        keys.press("9")
        keys.press("Enter")
        expect(page.get_by_role("alert")).to_contain_text("9 points are more than the maximum of 2 points")
        expect(page.locator("#points")).to_have_value("9")
        assert words == ["Failed to load resource: the server responded with a status of 409 (Conflict)"]


def test_a_folder_that_cannot_be_written(browser: Browser, tmp_path: Path) -> None:
    """If a review cannot be saved, the page keeps the typed text and saves the text later."""
    out = write_class(tmp_path)
    blocked = out / FILE
    with serving(out) as url, opened(browser, url) as (page, _words):
        page.keyboard.press("n")
        page.keyboard.press("c")
        page.keyboard.type("Keep me.")
        for draft in _drafts(out):
            # The test creates a folder with the name of the temporary file, because even root cannot
            # overwrite a folder.
            draft.mkdir()
        page.keyboard.press("Escape")
        expect(page.get_by_role("alert")).to_contain_text("Not saved: overrides.csv cannot be written")
        page.keyboard.press("n")
        expect(page.get_by_role("alert")).to_be_hidden()
        page.keyboard.press("p")
        expect(page.locator("#comment")).to_have_value("Keep me.")
        assert not blocked.exists()
        for draft in _drafts(out):
            draft.rmdir()
        page.keyboard.press("r")
        _saved(page)
        assert _rows(out) == {("s01", "Part 05.1"): ("", "Keep me.")}


def test_a_spreadsheet_saves_while_the_page_is_open(browser: Browser, tmp_path: Path) -> None:
    """The page does not delete a row that a spreadsheet program adds while the page is open."""
    out = write_class(tmp_path)
    with serving(out) as url, opened(browser, url) as (page, _words):
        page.keyboard.press("n")
        text = "student,chapter,part,points,comment,answer\ns02,05,05.1,0.5,mine,\n"
        (out / FILE).write_text(text)
        page.keyboard.press("1")
        page.keyboard.press("Enter")
        expect(page.get_by_role("status")).to_contain_text("Another program has changed overrides.csv")
        assert _rows(out) == {("s02", "05.1"): ("0.5", "mine"), ("s01", "Part 05.1"): ("1", "")}
        page.keyboard.press("n")
        expect(page.locator("#comment")).to_have_value("mine")


@pytest.mark.parametrize("colours", usual(1, {"light": "light", "dark": "dark"}))
def test_the_page_is_accessible_and_fits(browser: Browser, tmp_path: Path, colours: Colours) -> None:
    """axe-core finds no problem, the page fits into the window, and scripts from students do not run."""
    out = write_class(tmp_path)
    with serving(out) as url:
        for width in (1280, 900, 390):
            with opened(browser, url, width, colours) as (page, words):
                for shown in range(4):
                    expect(page.locator(f"body[data-shown='{shown}']")).to_be_visible()
                    assert page.evaluate("document.documentElement.scrollWidth") <= width
                    picture(page, f"review-{width}-{colours}-{shown}")
                    page.keyboard.press("n")
                # The content security policy allows only scripts from the page's own origin, so the test uses
                # the debugger to add axe-core.
                page.evaluate(AXE)
                assert violations(page) == []
                assert words == []


def test_only_a_selection_is_shown(browser: Browser, tmp_path: Path) -> None:
    """With --flagged, the page shows only answers with flags."""
    out = write_class(tmp_path)
    with serving(out, Wanted(flagged=True)) as url, opened(browser, url) as (page, _words):
        expect(page.locator("#progress")).to_have_text("s03: 1 of 1; 0 reviewed")
        expect(page.get_by_role("article")).to_contain_text("Similar: s01")


def _drafts(out: Path) -> list[Path]:
    """Return the paths of the temporary files of overrides.csv."""
    return [out / f".{FILE}.{os.getpid()}"]
