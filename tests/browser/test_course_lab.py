"""Tests of the start page of `course lab`."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser, expect

from tests.browser.pages import READY
from tests.lab.commands import lab


def test_the_file_browser_shows_the_chapters_first(browser: Browser, tmp_path: Path) -> None:
    """The file browser first shows the folder with the chapters."""
    with lab(COURSE_STATE=str(tmp_path)) as (_, address), browser.new_page() as page:
        page.goto(address, timeout=READY, wait_until="commit")
        files = page.locator("#filebrowser .jp-DirListing-content")
        expect(files).to_contain_text("05_write_a_server.ipynb", timeout=READY)
        page.locator("#filebrowser .jp-BreadCrumbs-home").click()
        expect(files.get_by_text("notebooks", exact=True)).to_be_visible(timeout=READY)
        expect(files.get_by_text("figures", exact=True)).to_be_visible()
        expect(files.get_by_text("solutions", exact=True)).to_have_count(0)
        expect(page.get_by_text("Python 3 (ipykernel) | Idle")).to_be_visible(timeout=READY)
        expect(page.locator(".lm-DockPanel-tabBar .lm-TabBar-tab")).to_contain_text(["00_start_the_graph"])
        expect(page.locator(".lm-TabBar-tab.jp-mod-dirty")).to_have_count(0)
