"""Compares `./course lab` with the unchanged `jupyter lab`, and with `./course lab --shared-graph`.

The measurements alternate between the two servers.
"""

from __future__ import annotations

import os
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import nbformat
from playwright.sync_api import BrowserContext, Page, sync_playwright

from course_pkg.ports import free_port
from tests.lab.commands import ADDRESS, ROOT, can_connect, user_environment
from tests.support import eventually

# These are the limits for the start of `course lab`: the ratio to the duration for `jupyter lab`, and the
# time in s.
START_RATIO, START_BAR = 0.75, 3.0
# These are the limits for a click in `course lab`: the ratio to the duration in `jupyter lab`, and the time
# in ms.
CLICK_RATIO, CLICK_BAR = 0.3, 12.0
WARM_UP = 10  # The benchmark ignores this number of clicks at the beginning.
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]
FLAGS += ["--disable-background-networking"]
# The selector excludes hidden tabs, because `jupyter lab` restores old tabs.
SHOWN = ".jp-NotebookPanel:not(.lm-mod-hidden)"
IDLE = f"() => document.querySelector('{SHOWN} .jp-Notebook-ExecutionIndicator[data-status=idle]')"
STEPS = ("address known", "page received", "notebook rendered", "kernel idle")
CELL = """
import ipywidgets
button, label = ipywidgets.Button(description="click"), ipywidgets.Label("0")
button.on_click(lambda _: setattr(label, "value", str(int(label.value) + 1)))
ipywidgets.VBox([button, label])
"""
COSTS = ("lab to page", "click", "check")
ISOLATION_RATIO = 1.05  # maximum ratio of the durations with and without a private network
CHECKS = """
import time
took = []
for _ in range(6):
    began = time.perf_counter()
    check("05.1")
    took.append(time.perf_counter() - began)
print("seconds of checks:", *took[1:])
"""
# The pause of 60 ms lets the kernel become idle before the next click.
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
# The two arguments of the function are a notebook and a folder for JupyterLab's settings.
Server = Callable[[Path, Path], AbstractContextManager[str]]


def start(runs: int = 5, notebook: str = "notebooks/00_start_the_graph.ipynb") -> bool:
    """Measure the start of each server with an empty browser cache and with a full cache."""
    rows: dict[str, list[list[float]]] = {name: [] for name in SERVERS}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        for _ in range(runs + 1):
            for name, server in SERVERS.items():
                state = Path(folder, name)
                context = playwright.chromium.launch_persistent_context(
                    state / "profile", executable_path=shutil.which("chromium"), args=FLAGS, headless=True
                )
                rows[name].append(times_of_start(context, server, (ROOT / notebook).resolve(), state))
                context.close()
    print(f"{'s after the command':26}", *(f"{name:>18}" for name in STEPS))
    for name, (first, *_) in rows.items():
        print(f"{name + ', empty browser cache':26}", *(f"{value:18.2f}" for value in first))
    medians = {}
    for name, (_, *later) in rows.items():
        columns = list(zip(*later, strict=True))
        medians[name] = statistics.median(columns[-1])
        print(f"{f'{name}, median of {runs}':26}", *(f"{statistics.median(each):18.2f}" for each in columns))
        print(f"{'':26} all: {[round(value, 2) for value in columns[-1]]}")
    return reported(medians, START_RATIO, START_BAR, "s")


def times_of_start(context: BrowserContext, server: Server, notebook: Path, state: Path) -> list[float]:
    """Return the time in s from the command to each step in STEPS."""
    began = time.perf_counter()
    with server(notebook, state) as address:
        marks = [time.perf_counter()]
        page = context.new_page()
        page.goto(address, wait_until="commit")
        marks.append(time.perf_counter())
        marks += until_usable(page)
    return [mark - began for mark in marks]


def until_usable(page: Page) -> list[float]:
    """Wait until the notebook is shown and its kernel is idle; return the times of these two events."""
    page.wait_for_selector(f"{SHOWN} .jp-RenderedMarkdown h1")
    rendered = time.perf_counter()
    page.wait_for_function(IDLE)
    return [rendered, time.perf_counter()]


def click(clicks: int = 100) -> bool:
    """Measure the clicks on each server twice."""
    notebook = ROOT / "tests" / "bench" / f"click-{os.getpid()}.ipynb"
    cells = [nbformat.v4.new_markdown_cell("# Click"), nbformat.v4.new_code_cell(CELL)]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel}), notebook)
    times: dict[str, list[float]] = {name: [] for name in SERVERS}
    try:
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(2):
                for name, server in SERVERS.items():
                    times[name] += times_of_clicks(server(notebook, Path(folder, name)), clicks)
    finally:
        notebook.unlink()
    medians = {name: statistics.median(values) for name, values in times.items()}
    for name, values in times.items():
        p95 = statistics.quantiles(values, n=20)[-1]
        print(f"{name:8} median {medians[name]:6.1f} ms   p95 {p95:6.1f} ms   ({len(values)} clicks)")
    return reported(medians, CLICK_RATIO, CLICK_BAR, "ms")


def times_of_clicks(server: AbstractContextManager[str], clicks: int) -> list[float]:
    """Open the notebook on a new page, and return the duration of each click in ms."""
    with server as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=FLAGS, headless=True
        )
        page = browser.new_page()
        page.goto(address)
        until_usable(page)
        page.get_by_role("menuitem", name="Run", exact=True).click()
        page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        page.wait_for_selector(".jupyter-button")
        page.wait_for_timeout(1000)
        times = [float(page.evaluate(CLICK)) for _ in range(WARM_UP + clicks)]
        browser.close()
    return times[WARM_UP:]


def reported(medians: dict[str, float], ratio_bar: float, bar: float, unit: str) -> bool:
    """Print the ratio of the medians, and the median of `course lab`.

    Return whether the ratio meets its limit.
    """
    ratio = medians["course"] / medians["stock"]
    print(f"course lab / stock: {ratio:.2f} (bar {ratio_bar}): {'met' if ratio <= ratio_bar else 'MISSED'}")
    met = medians["course"] <= bar
    print(f"course lab: {medians['course']:.2f} {unit} (bar {bar:g}): {'met' if met else 'MISSED'}")
    return ratio <= ratio_bar


@contextmanager
def course(notebook: Path, _state: Path, *options: str) -> Iterator[str]:
    """Run `./course lab` with these options; yield the address of the notebook."""
    command = [ROOT / "course", "lab", "--no-browser", *options, notebook]
    with started(command, user_environment()) as address:
        yield address


@contextmanager
def started(command: Sequence[str | Path], env: Mapping[str, str], cwd: Path | None = None) -> Iterator[str]:
    """Run a command that starts a lab; yield the address that the command prints."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=env, cwd=cwd, text=True) as process:
        assert process.stdout
        try:
            yield next(found[0] for line in process.stdout if (found := ADDRESS.search(line)))
        finally:
            process.send_signal(signal.SIGINT)
            process.stdout.read()


@contextmanager
def stock(notebook: Path, state: Path) -> Iterator[str]:
    """Run the unchanged JupyterLab with its settings in a folder; yield the address of the notebook."""
    port = free_port()
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}"]
    command += [f"--ServerApp.root_dir={ROOT}", "--IdentityProvider.token=t"]
    folders = {f"JUPYTER_{name}_DIR": str(state / name) for name in ("CONFIG", "DATA", "RUNTIME")}
    env = {**os.environ, **folders}
    with subprocess.Popen(command, stderr=subprocess.DEVNULL, env=env) as process:
        try:
            eventually(lambda: can_connect(port), timeout=60)
            yield f"http://127.0.0.1:{port}/lab/tree/{notebook.relative_to(ROOT)}?token=t"
        finally:
            process.terminate()


@contextmanager
def shared(notebook: Path, state: Path) -> Iterator[str]:
    """Run `./course lab` without a private network; yield the address of the notebook."""
    with course(notebook, state, "--shared-graph") as address:
        yield address


SERVERS: dict[str, Server] = {"stock": stock, "course": course}


def isolation(runs: int = 10) -> bool:
    """Measure a start, a click and a check, alternately with and without a private network."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    solved = nbformat.read(next((ROOT / "solutions").glob("05_*.ipynb")), as_version=4).cells
    end = next(at for at, each in enumerate(solved) if each.metadata.get("course", {}).get("check") == "05.1")
    cells = [*solved[:end], nbformat.v4.new_code_cell(CHECKS), nbformat.v4.new_code_cell(CELL)]
    notebook = ROOT / "tests" / "bench" / f"isolation-{os.getpid()}.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel}), notebook)
    servers: dict[str, Server] = {"shared": shared, "private": course}
    times: dict[str, dict[str, list[float]]] = {name: {what: [] for what in COSTS} for name in servers}
    try:
        for _ in range(runs):
            for name, server in servers.items():
                for what, values in zip(COSTS, costs(server, notebook), strict=True):
                    times[name][what] += values
    finally:
        notebook.unlink()
    met = True
    for what in COSTS:
        shared_s, private_s = (statistics.median(times[name][what]) for name in servers)
        met = met and private_s / shared_s <= ISOLATION_RATIO
        print(f"{what}: shared {shared_s:.3f} s, private {private_s:.3f} s, ratio {private_s / shared_s:.2f}")
    return met


def costs(server: Server, notebook: Path) -> tuple[list[float], list[float], list[float]]:
    """Return the duration of a start, of clicks and of checks in s."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=FLAGS, headless=True
        )
        began = time.perf_counter()
        with server(notebook, notebook.parent) as address:
            page = browser.new_page()
            page.goto(address)
            start = until_usable(page)[-1] - began
            page.get_by_role("menuitem", name="Run", exact=True).click()
            page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
            page.wait_for_selector(".jupyter-button", timeout=120_000)
            page.wait_for_timeout(1000)
            clicks = [float(page.evaluate(CLICK)) / 1000 for _ in range(WARM_UP + 20)][WARM_UP:]
            text = page.get_by_text("seconds of checks:").last.inner_text()
            checks = [float(word) for word in text.partition(":")[2].split()]
        browser.close()
    return [start], clicks, checks
