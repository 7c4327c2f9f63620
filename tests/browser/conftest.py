"""A page and a JupyterLab for the tests in this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page

from tests.browser.jupyter import Lab, new_page, running_lab


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """Open a page of its own for a test."""
    with new_page(browser) as page:
        yield page


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Start a JupyterLab, once for all tests of a worker."""
    with running_lab(tmp_path_factory.mktemp("lab")) as lab:
        yield lab
