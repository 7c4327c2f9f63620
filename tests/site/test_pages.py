"""Tests of the pages in a real browser."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import pytest
from playwright.sync_api import Browser, Page, expect

from course_pkg.site.scripts import fronts
from tests.browser.pages import picture
from tests.support import usual

AXE = Path(__file__).with_name("axe.min.js").read_text("utf-8")
# RULES contains rules that are added to axe-core's default rules.
RULES = {name: {"enabled": True} for name in ("target-size", "label-content-name-mismatch")}
# A page is not allowed to fetch files, so axe-core cannot preload files.
OPTIONS = {"rules": RULES, "preload": False}
# This rule is the slowest rule of axe-core; its result does not depend on the window's width.
CONTRAST = "color-contrast"
WIDTHS = (1200, 390)
COLOURS: tuple[Literal["light", "dark"], ...] = ("light", "dark")
PAGE = "00_panels.html"
# Every test run checks the pages in `ENOUGH`. A test run checks the other pages only after a change of the
# site.
ENOUGH = ("index.html", "glossary.html", "05_write_a_server.html", PAGE)


@contextmanager
def reader(
    browser: Browser, width: int = 1200, colours: Literal["light", "dark"] = "light"
) -> Iterator[Page]:
    """Open a page in a browser that can connect only to 127.0.0.1.

    The test fails if a request fails, a script raises an error, or the console shows a warning.
    """
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=colours)
    troubles: list[str] = []
    context.route(lambda url: not url.startswith(("file:", "http://127.0.0.1:")), lambda route: route.abort())
    page = context.new_page()
    page.on("requestfailed", lambda request: troubles.append(f"failed: {request.url}"))
    page.on(
        "response", lambda answer: troubles.append(f"{answer.status} {answer.url}") if not answer.ok else None
    )
    page.on("console", lambda said: troubles.append(said.text) if said.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: troubles.append(str(error)))
    yield page
    context.close()
    assert troubles == []


def pages(site: Path) -> list[str]:
    """Return the file names of a site's pages, except book.html (one page with all chapters)."""
    return sorted(path.name for path in site.glob("*.html") if path.name != "book.html")


def open_page(page: Page, site: Path, name: str) -> None:
    """Open a page from the local folder, and wait until its panels are drawn."""
    page.goto((site / name).as_uri())
    expect(page.locator("[data-panel]:empty")).to_have_count(0)


@pytest.mark.parametrize("way", usual(1, {"folder": "folder", "server": "server"}))
def test_every_page_is_whole_without_a_network(
    browser: Browser, course: Path, panels: Path, served: dict[Path, str], way: str
) -> None:
    """Each page draws all its panels and fits into the window, and no request fails."""
    with reader(browser, 390) as page:
        for site in (course, panels):
            for name in [*pages(site), *(["book.html"] if site == course else [])]:
                page.goto((site / name).as_uri() if way == "folder" else f"{served[site]}/{name}")
                expect(page.locator("[data-panel]:empty")).to_have_count(0)
                assert page.evaluate("document.documentElement.scrollWidth") <= 390, name


def test_axe_finds_no_problem_on_some_pages(browser: Browser, course: Path, panels: Path) -> None:
    """In a wide window with the light theme, axe-core finds no problem on the pages in `ENOUGH`."""
    assert problems(browser, [course, panels], WIDTHS[0], "light", ENOUGH) == {}


@pytest.mark.when_changed
@pytest.mark.timeout(360)  # This test needs much CPU time, and the machine may be busy.
@pytest.mark.parametrize("colours", COLOURS)
@pytest.mark.parametrize("width", WIDTHS)
def test_axe_finds_no_problem(
    browser: Browser, course: Path, panels: Path, width: int, colours: Literal["light", "dark"]
) -> None:
    """axe-core finds no problem on any page, with and without the search dialog.

    The program `tests.bench.site axe` checks every rule with every width and theme.
    """
    names = ENOUGH if (width, colours) == (390, "dark") else [*pages(course), *pages(panels)]
    assert problems(browser, [course, panels], width, colours, names) == {}


def problems(
    browser: Browser,
    sites: Iterable[Path],
    width: int,
    colours: Literal["light", "dark"],
    names: Container[str],
) -> dict[str, list[str]]:
    """Return the problems that axe-core finds on the named pages, with and without the search dialog."""
    found, options = {}, options_for(width, colours)
    with reader(browser, width, colours) as page:
        for site in sites:
            for name in pages(site):
                if name not in names:
                    continue
                open_page(page, site, name)
                page.evaluate(AXE)
                found[name] = violations(page, options)
                look_for(page, "service")
                # While the search dialog is open, axe-core checks only the dialog.
                found[f"{name}, searching"] = violations(page, options, "dialog")
        picture(page, f"site-search-{width}-{colours}")
    return {name: what for name, what in found.items() if what}


def options_for(width: int, colours: str) -> dict[str, Any]:
    """Return axe-core's options: the rules that are checked with this window width and theme."""
    if colours == "dark":
        return {**OPTIONS, "runOnly": [CONTRAST]}
    return OPTIONS if width == WIDTHS[0] else {**OPTIONS, "rules": {**RULES, CONTRAST: {"enabled": False}}}


def violations(page: Page, options: Mapping[str, Any] = OPTIONS, part: str = "html") -> list[str]:
    """Return the problems that axe-core finds in a part of the page. The page must have loaded axe-core."""
    run = "([part, options]) => axe.run(part, options)"
    found: list[dict[str, Any]] = page.evaluate(run, [part, options])["violations"]
    return [f"{each['id']}: {node['html'][:200]}" for each in found for node in each["nodes"]]


def look_for(page: Page, words: str) -> None:
    """Open the search dialog with the key "/", type the words, and wait for the results."""
    page.keyboard.press("/")
    page.get_by_role("searchbox").fill(words)
    expect(page.get_by_role("dialog").get_by_role("status")).to_contain_text("found")


def test_every_kind_of_panel_is_drawn(browser: Browser, panels: Path) -> None:
    """The page draws each panel from its saved state."""
    with reader(browser) as page:
        open_page(page, panels, PAGE)
        shown = page.locator("[data-panel]").evaluate_all(
            "places => places.map(place => place.dataset.panel)"
        )
        assert set(shown) == set(fronts()) - {"choices"}
        expect(page.locator("[data-panel] > .ros-panel")).to_have_count(len(shown))
        expect(page.get_by_role("img", name="Figure: time (s), delay (ms), A line")).to_be_visible()
        picture(page, "site-panels")


def test_the_book_draws_its_panels_without_animation_frames(browser: Browser, panels: Path) -> None:
    """The page book.html draws all panels without animation frames and timers.

    Chromium does not run animation frames while it prints.
    """
    with reader(browser) as page:
        page.add_init_script("requestAnimationFrame = setTimeout = () => 0")
        open_page(page, panels, "book.html")
        assert page.locator("[data-panel] > .ros-panel").count() >= len(fronts()) - 1


def test_a_recorded_form_answers(browser: Browser, panels: Path) -> None:
    """If the reader enters a recorded request, the page shows the recorded response.

    A panel without a recording shows that there is no kernel.
    """
    with reader(browser) as page:
        open_page(page, panels, PAGE)
        recorded, saved = page.get_by_role("region", name="Service panel").all()
        for field, value in {"length": "1", "width": "2", "height": "3"}.items():
            recorded.get_by_label(field).fill(value)
        recorded.get_by_role("button", name="Call").click()
        expect(recorded.get_by_text("Recorded: Answered in")).to_be_visible()
        expect(recorded.get_by_role("row", name="volume")).to_contain_text("6.0")
        expect(saved.get_by_text("No kernel answers")).to_be_visible()


def test_the_turtles_can_be_replayed(browser: Browser, panels: Path) -> None:
    """With a slider, the reader selects the time in the recording of the turtles."""
    with reader(browser) as page:
        open_page(page, panels, PAGE)
        turtles = page.get_by_role("region", name="Turtle panel")
        handle = turtles.get_by_role("slider")
        expect(handle).to_be_enabled()
        handle.fill("0")
        expect(turtles).to_contain_text("0.0 of")


def test_the_graph_can_be_replayed(browser: Browser, panels: Path) -> None:
    """In the recording of a graph, the key Home moves the slider to the beginning."""
    with reader(browser) as page:
        open_page(page, panels, PAGE)
        graph = page.get_by_role("region", name="Graph panel")
        expect(graph.get_by_text("this is a recording")).to_be_visible()
        log = graph.locator('[data-key="topic /rosout"]')
        expect(log).to_be_visible()
        graph.get_by_role("slider").press("Home")
        expect(graph).to_contain_text("0.0 of")
        expect(log).not_to_be_attached()


def test_the_search_leads_to_a_section(browser: Browser, course: Path) -> None:
    """The reader can open a section from the search dialog with the keyboard only."""
    with reader(browser) as page:
        open_page(page, course, "index.html")
        look_for(page, "idempotent")
        page.keyboard.press("ArrowDown")
        page.keyboard.press("Enter")
        expect(page.locator(":target")).to_be_in_viewport()
        assert "#" in page.url


def test_a_search_without_results_shows_a_message(browser: Browser, course: Path) -> None:
    """If a search finds nothing, the message contains the search term; Escape closes the dialog."""
    with reader(browser) as page:
        open_page(page, course, "index.html")
        page.get_by_role("button", name="Search").click()
        page.get_by_role("searchbox").fill("zyzzyva")
        expect(page.get_by_role("dialog")).to_contain_text("No section contains “zyzzyva”.")
        page.keyboard.press("Escape")
        expect(page.get_by_role("dialog")).to_be_hidden()


def test_the_next_page_keeps_the_chosen_colours(
    browser: Browser, served: dict[Path, str], course: Path
) -> None:
    """A click on the theme button changes the theme, and the next page has the same theme."""
    with reader(browser, colours="light") as page:
        page.goto(served[course])
        button = page.locator("button.theme")
        for label in ("Light", "Dark"):
            button.click()
            expect(button).to_have_text(label)
        page.goto(f"{served[course]}/glossary.html")
        expect(page.locator("html")).to_have_attribute("data-theme", "dark")
        assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(20, 23, 27)"
        button.click()
        expect(page.locator("html")).not_to_have_attribute("data-theme", "dark")


def test_the_contents_mark_the_current_section(browser: Browser, course: Path) -> None:
    """The table of contents marks the section at the top of the window."""
    with reader(browser) as page:
        open_page(page, course, "05_write_a_server.html")
        page.locator("h2").nth(4).evaluate("heading => heading.scrollIntoView({behavior: 'instant'})")
        heading = page.locator("h2").nth(4).evaluate("heading => heading.firstChild.textContent")
        expect(page.locator(".contents [aria-current]")).to_have_text(heading.strip())
    with reader(browser, 390) as page:
        open_page(page, course, "05_write_a_server.html")
        expect(page.locator(".contents a").first).to_be_hidden()
        page.get_by_text("On this page").click()
        expect(page.locator(".contents a").first).to_be_visible()


def test_code_can_be_copied(browser: Browser, course: Path) -> None:
    """A click on a cell's copy button copies the text of the cell."""
    with reader(browser) as page:
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        open_page(page, course, "05_write_a_server.html")
        first = page.locator(".copied").first
        first.hover()
        first.get_by_role("button").click()
        expect(first.get_by_role("button")).to_have_text("Copied")
        assert page.evaluate("navigator.clipboard.readText()").startswith("from course_pkg import check")


def test_a_page_can_be_read_without_scripts(browser: Browser, panels: Path) -> None:
    """If scripts are disabled, the page shows the code and a message about the missing panels."""
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((panels / PAGE).as_uri())
    expect(page.locator("noscript p")).to_be_visible()
    expect(page.locator("pre.in").first).to_be_visible()
    expect(page.get_by_role("button")).to_have_count(0)
    context.close()


def test_a_page_opens_no_connection(browser: Browser, course: Path, served: dict[Path, str]) -> None:
    """The content security policy of a page forbids connections, and forbids scripts without a nonce."""
    context = browser.new_context()
    page = context.new_page()
    page.goto(served[course])
    assert page.evaluate("fetch('index.html').then(() => 'fetched', () => 'refused')") == "refused"
    page.evaluate(
        "const own = document.createElement('script'); own.text = 'ran = 1'; document.body.append(own)"
    )
    assert page.evaluate("window.ran") is None
    context.close()
