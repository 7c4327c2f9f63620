"""Tests of the HTML pages of `course grade` in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from course_pkg.grading.reports import write_reports
from tests.grading.grades import class_of, nasty, refused

CONTRAST = (Path(__file__).parent / "contrast.js").read_text()


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the reports of a class with every possible result."""
    out = tmp_path_factory.mktemp("reports")
    grades = [*class_of(30, ("05", "06")), refused("s31"), refused("s32", ""), nasty()]
    write_reports([replace(grade, sandboxed=grade.student != "s07") for grade in grades], out)
    return out


@pytest.fixture(params=["light", "dark"])
def said(request: pytest.FixtureRequest, browser: Browser) -> Iterator[tuple[Page, list[str]]]:
    """Open a narrow page, and collect the browser's messages about blocked scripts."""
    context = browser.new_context(color_scheme=request.param, viewport={"width": 390, "height": 800})
    page, words = context.new_page(), []
    page.on("console", lambda message: words.append(message.text))
    page.on("pageerror", lambda error: words.append(str(error)))
    page.on("dialog", lambda dialog: words.append(dialog.message))
    page.on("request", lambda each: words.extend([] if each.url.startswith("file:") else [each.url]))
    yield page, words
    context.close()


def test_every_page_can_be_read(reports: Path, said: tuple[Page, list[str]]) -> None:
    """On a phone, each page fits into the window, and each text has enough contrast."""
    page, words = said
    paths = [reports / "class.html", *sorted((reports / "feedback").glob("*.html"))[:12]]
    for path in paths:
        page.goto(path.as_uri())
        assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, path.name
        page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
        assert page.evaluate(f"({CONTRAST})(document.body)") == [], path.name
        assert page.evaluate("getComputedStyle(document.querySelector('main')).maxWidth") == "832px"
    assert words == []


def test_links_lead_to_the_feedback(reports: Path, said: tuple[Page, list[str]]) -> None:
    """Each link of the class page leads to an existing page."""
    page, _ = said
    page.goto((reports / "class.html").as_uri())
    links = page.eval_on_selector_all("a", "links => links.map(link => decodeURI(link.href))")
    assert len(set(links)) == 33
    for link in links:
        assert Path(link.removeprefix("file://")).is_file()
