"""Fixtures for browser tests: a page and a JupyterLab."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, ViewportSize

from tests.browser.jupyter import Lab, running_lab
from tests.browser.pages import new_page, no_errors

SIZE: ViewportSize = {"width": 1280, "height": 1000}  # size of the window in px


@pytest.fixture(scope="session")
def context(browser: Browser) -> Iterator[BrowserContext]:
    """Return a browser context; its pages share a cache and have access to the clipboard."""
    context = browser.new_context(viewport=SIZE, permissions=["clipboard-read", "clipboard-write"])
    yield context
    context.close()


@pytest.fixture
def page(context: BrowserContext) -> Iterator[Page]:
    """Open a page for one test."""
    with new_page(context) as page:
        yield page


@pytest.fixture(scope="session")
def _lab_page(context: BrowserContext) -> Iterator[Page]:
    page = context.new_page()
    yield page
    page.close()


@pytest.fixture
def lab_page(_lab_page: Page) -> Iterator[Page]:
    """Return the JupyterLab page that all tests of a pytest worker share."""
    _lab_page.set_viewport_size(SIZE)
    with no_errors(_lab_page):
        yield _lab_page


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Start one JupyterLab for all tests of a pytest worker."""
    with running_lab(tmp_path_factory.mktemp("lab")) as lab:
        yield lab
