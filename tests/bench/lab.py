"""Prints how long a warm `./course lab` takes, from the command to a page whose kernel is idle.

usage: ./course run python tests/bench/lab.py [RUNS [NOTEBOOK]]
`./course test` installs the browser that it needs.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import BrowserContext, Page, sync_playwright

ROOT = Path(__file__).parents[2]
NOTEBOOK = sys.argv[2:]  # the first chapter unless given
KEPT = 6.0  # s after which a start has kept what it keeps for the next
USABLE = 3  # the step that counts
BAR = 3.0  # s from the command to a usable page
ADDRESS = re.compile(rb"http://\S+token=\S+")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
]
SHOWN = ".jp-NotebookPanel:not(.lm-mod-hidden)"  # other tabs may be restored from the last time
IDLE = f"() => document.querySelector('{SHOWN} .jp-Notebook-ExecutionIndicator[data-status=idle]')"


def main(runs: int) -> int:
    """Measure with an empty browser cache, then as often as asked with the cache of the run before.

    Warm means that `./course lab` has run before: what it keeps for its next start is there.
    """
    with lab(*NOTEBOOK):
        time.sleep(KEPT)
    names = ("address printed", "page received", "notebook rendered", "kernel idle", "page at work")
    with tempfile.TemporaryDirectory() as profile, sync_playwright() as playwright:
        rows = []
        for _ in range(runs + 1):
            context = playwright.chromium.launch_persistent_context(
                profile, executable_path=shutil.which("chromium"), args=FLAGS, headless=True
            )
            rows.append(measure(context))
            context.close()
    print("s after the command       ", *(f"{name:>18}" for name in names))
    print("empty browser cache       ", *(f"{value:18.2f}" for value in rows[0]))
    medians = [statistics.median(column) for column in zip(*rows[1:], strict=True)]
    print(f"median of {runs:2}             ", *(f"{value:18.2f}" for value in medians))
    print(
        f"bar {BAR} s: {'met' if medians[USABLE] <= BAR else 'MISSED'};",
        f"all: {[round(row[USABLE], 2) for row in rows[1:]]}",
    )
    page = medians[USABLE] - medians[0]
    print(f"Of the {page:.2f} s from the address on, the page's one thread worked {medians[-1]:.2f} s.")
    return 0


def measure(context: BrowserContext) -> list[float]:
    """Return the seconds from the command to each step on the way to a usable page, and the page's own."""
    page = context.new_page()
    session = context.new_cdp_session(page)
    session.send("Performance.enable")
    with lab(*NOTEBOOK) as (address, started):
        marks = [time.perf_counter()]
        page.goto(address, wait_until="commit")
        marks.append(time.perf_counter())
        marks += until_usable(page)
        metrics = {item["name"]: item["value"] for item in session.send("Performance.getMetrics")["metrics"]}
    return [*(mark - started for mark in marks), float(metrics["TaskDuration"])]


def until_usable(page: Page) -> list[float]:
    """Wait for the notebook and its kernel; return the times at which they were there."""
    page.wait_for_selector(f"{SHOWN} .jp-RenderedMarkdown h1")
    rendered = time.perf_counter()
    page.wait_for_function(IDLE)
    return [rendered, time.perf_counter()]


@contextmanager
def lab(*arguments: str) -> Iterator[tuple[str, float]]:
    """Run `./course lab`; yield its address, and when the command was given."""
    env = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
    started = time.perf_counter()
    with subprocess.Popen(
        [ROOT / "course", "lab", "--no-browser", *arguments], stdout=subprocess.PIPE, env=env
    ) as process:
        try:
            assert process.stdout
            for line in process.stdout:
                if found := ADDRESS.search(line):
                    yield found[0].decode(), started
                    break
        finally:
            process.send_signal(signal.SIGINT)
            process.stdout.read()


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 5))
