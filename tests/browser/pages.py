"""Functions for pages in the browser."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from playwright.sync_api import Browser, BrowserContext, Error, Locator, Page, expect

from course_pkg.panels.panel import Panel

HERE = Path(__file__).parent
Colours = Literal["light", "dark"]
# In a stack trace, JupyterLab's scripts have these addresses, and the course's scripts have blob: addresses.
JUPYTERLAB = re.compile(r"https?://[^ ]*/static/lab/")
READY = 60_000  # On a busy machine, a browser, a server and a kernel need up to this time in ms to start.
HOST = (HERE / "host.html").read_text()

# This function runs in the page and returns the texts with too little contrast.
FAINT = (HERE / "contrast.js").read_text()


@contextmanager
def new_page(context: BrowserContext) -> Iterator[Page]:
    """Open a page. The test fails if a script on this page raises an error."""
    page = context.new_page()
    with no_errors(page):
        yield page
    page.close()


@contextmanager
def no_errors(page: Page) -> Iterator[None]:
    """Fail if a script of the course raises an error during the `with` block."""
    errors: list[str] = []

    def keep(error: Error) -> None:
        stack = error.stack or ""
        if not JUPYTERLAB.search(stack) or "blob:" in stack:
            errors.append(stack or str(error))

    page.on("pageerror", keep)
    yield
    page.remove_listener("pageerror", keep)
    assert errors == [], errors


def panel(page: Page, label: str = "Service panel") -> Locator:
    """Return the panel with this accessible name."""
    found = page.get_by_role("region", name=label, exact=True)
    expect(found).to_be_visible(timeout=READY)
    return found


def picture(target: Page | Locator, name: str) -> None:
    """If the variable COURSE_ARTIFACTS is set, save a screenshot to this folder."""
    if folder := os.environ.get("COURSE_ARTIFACTS"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        target.screenshot(path=Path(folder) / f"{name}.png")


def save(widget: Panel, path: Path, theme: str = "light") -> str:
    """Save the widget as an HTML page that needs no kernel, and return the address of the page."""
    state = {
        name: value
        for name, value in widget.get_state().items()
        if isinstance(value, str | list | dict | bool)
    }
    text = json.dumps(state).replace("</", "<\\/")
    path.write_text(HOST.replace("THEME", theme).replace("CSS", state["_css"]).replace("STATE", text))
    widget.close()
    return path.as_uri()


@contextmanager
def page_at(browser: Browser, address: str, width: int, colours: Colours) -> Iterator[tuple[Page, list[str]]]:
    """Open an address; yield the page, and a list of its console messages and script errors."""
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=colours)
    page, words = context.new_page(), list[str]()
    page.on("console", lambda message: words.append(message.text))
    page.on("pageerror", lambda error: words.append(str(error)))
    page.on("dialog", lambda dialog: words.append(dialog.message))
    page.goto(address)
    yield page, words
    context.close()
