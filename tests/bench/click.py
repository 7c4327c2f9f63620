"""Prints the time from a click to Python and back to the page, of `course lab` and of the stock JupyterLab.

usage: ./course run python tests/bench/click.py [CLICKS]
`./course test` installs the browser that it needs.
"""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

import nbformat
from lab import FLAGS, ROOT, lab, until_usable
from playwright.sync_api import Page, sync_playwright

from course_pkg.lab.ports import free_port

BAR, RATIO = 12.0, 0.3  # ms; of the stock server's median
WARM_UP = 10  # clicks
CELL = """
import ipywidgets
button, label = ipywidgets.Button(description="click"), ipywidgets.Label("0")
button.on_click(lambda _: setattr(label, "value", str(int(label.value) + 1)))
ipywidgets.VBox([button, label])
"""
# The pause lets the kernel come to rest after the click before, as it does between a person's clicks.
CLICK = """async () => {
    await new Promise(done => setTimeout(done, 60))
    const label = document.querySelector(".widget-label")
    const button = document.querySelector(".jupyter-button")
    const changed = new Promise(done => new MutationObserver((_, it) => { it.disconnect(); done() })
        .observe(label, {childList: true, characterData: true, subtree: true}))
    const start = performance.now()
    button.click()
    await changed
    return performance.now() - start
}"""


def main(clicks: int) -> int:
    """Measure both servers in turn, twice, so that a slow minute of the machine hits both."""
    notebook = ROOT / "tests" / "bench" / f"click-{os.getpid()}.ipynb"
    book = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_markdown_cell("# Click"), nbformat.v4.new_code_cell(CELL)]
    )
    book.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(book, notebook)
    times: dict[str, list[float]] = {"stock": [], "course": []}
    try:
        for _ in range(2):
            times["stock"] += measured(stock(notebook), clicks)
            times["course"] += measured(course(notebook), clicks)
    finally:
        notebook.unlink()
    medians = {name: statistics.median(values) for name, values in times.items()}
    for name, values in times.items():
        p95 = statistics.quantiles(values, n=20)[-1]
        print(f"{name:8} median {medians[name]:6.1f} ms   p95 {p95:6.1f} ms   ({len(values)} clicks)")
    ratio = medians["course"] / medians["stock"]
    met = medians["course"] <= BAR and ratio <= RATIO
    print(f"ratio {ratio:.2f} (bar {RATIO}), median bar {BAR:.0f} ms: {'met' if met else 'MISSED'}")
    return 0


@contextmanager
def course(notebook: Path) -> Iterator[str]:
    """Run `./course lab`; yield the notebook's address."""
    with lab(str(notebook)) as (address, _):
        yield address


@contextmanager
def stock(notebook: Path) -> Iterator[str]:
    """Run JupyterLab as it comes; yield the notebook's address."""
    port = free_port()
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}"]
    command += [f"--ServerApp.root_dir={ROOT}", "--IdentityProvider.token=t"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        try:
            while not answers(port):
                time.sleep(0.1)
            yield f"http://127.0.0.1:{port}/lab/tree/{notebook.relative_to(ROOT)}?token=t"
        finally:
            process.terminate()


def answers(port: int) -> bool:
    """Say whether the server is up."""
    try:
        urlopen(f"http://127.0.0.1:{port}/api", timeout=5).close()
    except (URLError, OSError):
        return False
    return True


def measured(server: Iterator[str], clicks: int) -> list[float]:
    """Return the milliseconds of each click in a page of its own."""
    with server as address, sync_playwright() as playwright:  # type: ignore[attr-defined]
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=FLAGS, headless=True
        )
        page = browser.new_page()
        page.goto(address)
        until_usable(page)
        run_all(page)
        times = [float(page.evaluate(CLICK)) for _ in range(WARM_UP + clicks)]
        browser.close()
    return times[WARM_UP:]


def run_all(page: Page) -> None:
    """Run every cell, and wait for the button."""
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    page.wait_for_selector(".jupyter-button")
    page.wait_for_timeout(1000)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 100))
