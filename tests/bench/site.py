"""Measures the site and the notebooks: pages, accessibility, and the validation of the solutions.

usage: ./course run python -m tests.bench.site pages|axe|nbval|listeners [OPTION …]
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from gzip import compress
from itertools import cycle, islice, product
from pathlib import Path

from playwright.sync_api import sync_playwright

from course_pkg.authoring.execute import surroundings, workers_here
from course_pkg.authoring.notebook_store import NotebookStore, text_of
from course_pkg.authoring.validate import validate
from course_pkg.ros.process.supervisor import descendants
from course_pkg.setup import Places
from course_pkg.site.runs import Runs
from tests.bench.commands import alternate, run_command
from tests.browser.chromium import chromium
from tests.site.test_pages import AXE, COLOURS, WIDTHS, look_for, open_page, pages, reader, violations

# pages: measures the duration of a build of the site, the size of the pages, and the time until the first
# panel is drawn. Run `./course site` with every chapter before this benchmark. The benchmark compares the
# build with `jupyter nbconvert --to html` of the same 14 executed notebooks. If the course has fewer
# chapters, some chapters are used twice.

PAGES = 14
ROUNDS = 5
LOADS = 5
BUILD = """
import sys
from pathlib import Path
from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.site.build import Settings, write_site
write_site(Settings(Path(sys.argv[2]), execute=False), NotebookStore(Path(sys.argv[1])))
"""
FIRST_PANEL = """
window.firstPanel = new Promise((resolve) => new MutationObserver((_changes, observer) => {
  if (!document.querySelector(".ros-panel")) return;
  observer.disconnect();
  requestAnimationFrame(() => requestAnimationFrame(() => resolve(performance.now())));
}).observe(document, { childList: true, subtree: true }));
"""


def pages_main() -> None:
    """Measure builds, sizes and panels, and print the results."""
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        root = Path(folder)
        write_notebooks(root)
        speed(root)
        weights(root / "site")
        first_panels(root / "site")


def write_notebooks(root: Path) -> None:
    """Write 14 executed notebooks; if the course has fewer chapters, write some chapters twice."""
    runs, solutions = Runs(), NotebookStore().solutions()
    (root / "solutions").mkdir()
    for number, path in enumerate(islice(cycle(solutions), PAGES)):
        notebook = runs.latest(path)
        if notebook is None:
            sys.exit(f"{path.stem} has not run yet: type ./course site")
        (root / "solutions" / f"{number:02}{path.name[2:]}").write_text(text_of(notebook), "utf-8")
    size = sum(len(json.dumps(path.read_text("utf-8"))) for path in (root / "solutions").iterdir())
    print(f"{PAGES} notebooks, {size / 1000:.0f} kB, of {len(solutions)} chapters")


def speed(root: Path) -> None:
    """Build the site and nbconvert's pages alternately, and print the median durations."""
    ours = [sys.executable, "-c", BUILD, str(root), str(root / "site")]
    notebooks = sorted(map(str, (root / "solutions").glob("*.ipynb")))
    theirs = [
        sys.executable,
        "-m",
        "jupyter",
        "nbconvert",
        "--to",
        "html",
        "--output-dir",
        str(root / "html"),
    ]
    contestants = {"course site": lambda: run(ours), "nbconvert": lambda: run([*theirs, *notebooks])}
    took = alternate(contestants, ROUNDS)
    site, peer = took["course site"] / 1000, took["nbconvert"] / 1000
    print(f"build: {site:.2f} s; jupyter nbconvert --to html: {peer:.2f} s; ratio {peer / site:.1f}")


def run(command: Sequence[str]) -> None:
    """Run a command and wait until it exits."""
    subprocess.run(command, check=True, capture_output=True)


def weights(site: Path) -> None:
    """Print the sizes of the pages and of their shared files."""
    own = [path.stat().st_size for path in site.glob("[0-9]*.html")]
    packed = [len(compress(path.read_bytes())) for path in site.glob("[0-9]*.html")]
    print(f"own part: median {statistics.median(own) / 1000:.1f} kB, most {max(own) / 1000:.1f} kB; ", end="")
    print(f"gzipped: median {statistics.median(packed) / 1000:.1f} kB")
    shared = {path.name: len(compress(path.read_bytes())) for path in (site / "assets").iterdir()}
    loaded = {name: size for name, size in shared.items() if name not in ("texts.js", "LICENSES.txt")}
    print(f"shared part, gzipped: {sum(loaded.values()) / 1000:.1f} kB {loaded}; ", end="")
    print(f"texts of the search, loaded when one begins: {shared['texts.js'] / 1000:.1f} kB")


def first_panels(site: Path) -> None:
    """Print the time from the navigation until the first panel of the page is painted."""
    flags = ["--no-sandbox", "--disable-gpu"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=flags)
        times = []
        for path in sorted(site.glob("[0-9]*.html")):
            for _ in range(LOADS):
                page = browser.new_page()
                page.add_init_script(FIRST_PANEL)
                page.goto(path.as_uri())
                times.append(page.evaluate("window.firstPanel"))
                page.close()
        browser.close()
    middle, last = statistics.median(times), max(times)
    print(f"first panel: median {middle:.0f} ms, slowest {last:.0f} ms, {len(times)} loads")


# axe: checks the accessibility of a whole site with all rules of axe-core. Arguments: `[SITE]`. SITE is the
# folder of a site. The default is the last site that `./course site` wrote. Each page is checked in a wide
# and a narrow window, in the light and dark themes, and with the search open and closed. The tests of the
# site check fewer combinations, because some combinations give the same result.


def axe_main() -> None:
    """Print each violation, and the total numbers of violations and pages."""
    site = Path(sys.argv[1]) if len(sys.argv) > 1 else Places.of().cache / "site" / "pages"
    count = 0
    with chromium() as browser:
        for width, colours in product(WIDTHS, COLOURS):
            with reader(browser, width, colours) as page:
                for name in pages(site):
                    open_page(page, site, name)
                    page.evaluate(AXE)
                    found = violations(page)
                    look_for(page, "service")
                    found += violations(page)
                    count += len(found)
                    for each in found:
                        print(f"{name} {width} {colours}: {each}")
    print(f"{count} violations on {len(pages(site))} pages, {len(WIDTHS) * len(COLOURS)} ways each")


# nbval: prints how long nbval needs for all solutions, serially and in parallel. Arguments: `[WORKERS …]`.
# The default for WORKERS is the number of workers that `course` uses on this machine.

SOLUTIONS = sorted((Path(__file__).parents[2] / "solutions").glob("*.ipynb"))
BAR = 0.45  # A parallel run may take at most this fraction of the duration of a serial run.
LIMIT = 3600.0  # One run may take up to this time in s.


def nbval_main() -> int:
    """Run the notebooks serially and then in parallel, and print the ratios of the durations."""
    counts = [int(count) for count in sys.argv[1:]] or [workers_here(len(SOLUTIONS))]
    print(
        f"{len(SOLUTIONS)} solutions, {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} before the start"
    )
    serial, busy = measure(1)
    print(f"serial: {serial:.1f} s, processor time {busy:.1f} s")
    for count in counts:
        seconds, busy = measure(count)
        ratio = seconds / serial
        print(
            f"{count} workers: {seconds:.1f} s, processor time {busy:.1f} s; ratio {ratio:.2f}, "
            f"bar {BAR}: {'met' if ratio <= BAR else 'MISSED'}"
        )
    return 0


def measure(workers: int) -> tuple[float, float]:
    """Return the duration of one run, and the CPU time of its processes, in s."""
    before, started = _spent(), time.perf_counter()
    outcome = validate(SOLUTIONS, workers=workers, timeout=LIMIT)
    seconds = time.perf_counter() - started
    if outcome.returncode:
        print(outcome.stdout[-3000:])
        sys.exit(f"With {workers} workers, an output differs from the stored output. Correct this first.")
    return seconds, _spent() - before


def _spent() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


# listeners: prints how many listening sockets each chapter opens, and which of them are not on 127.0.0.1.

LISTEN = "0A"
LOOPBACK = ("0100007F", "00000000000000000000000001000000", "0000000000000000FFFF00000100007F")


def listeners_main() -> None:
    """Run each chapter, and print its listening sockets. Exit with 1 if a socket is not on 127.0.0.1."""
    away: set[str] = set()
    for path in SOLUTIONS:
        seen = listeners_during(path)
        foreign = {address for address in seen if address.partition(":")[0] not in LOOPBACK}
        away |= foreign
        print(f"{path.stem}: {len(seen)} sockets listened, {len(foreign)} of them off 127.0.0.1")
    sys.exit(bool(away))


def listeners_during(path: Path) -> set[str]:
    """Return the addresses on which the processes of a chapter listened, in the format of /proc/net/tcp."""
    convert = [
        sys.executable,
        "-m",
        "jupyter",
        "execute",
        str(path),
        "--output",
        "/dev/null",
        "--timeout=120",
    ]
    seen: set[str] = set()
    with surroundings() as (folder, environment):
        with subprocess.Popen(
            convert, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        ) as run:
            while run.poll() is None:
                seen |= listening([run.pid, *descendants(run.pid)])
                try:
                    run.wait(0.05)
                except subprocess.TimeoutExpired:
                    continue
        if run.returncode:
            raise SystemExit(f"{path.name} did not run to its end")
    return seen


def listening(pids: list[int]) -> set[str]:
    """Return the addresses on which the given processes listen."""
    sockets = {inode for pid in pids for inode in inodes(pid)}
    tables = [Path("/proc/net/tcp"), Path("/proc/net/tcp6")]
    rows = [line.split() for table in tables if table.exists() for line in table.read_text().splitlines()[1:]]
    return {row[1] for row in rows if row[3] == LISTEN and row[9] in sockets}


def inodes(pid: int) -> set[str]:
    """Return the inodes of the open sockets of a process."""
    try:
        links = [os.readlink(entry) for entry in os.scandir(f"/proc/{pid}/fd")]
    except OSError:
        return set()
    return {link.removeprefix("socket:[").removesuffix("]") for link in links if link.startswith("socket:[")}


if __name__ == "__main__":
    run_command({"pages": pages_main, "axe": axe_main, "nbval": nbval_main, "listeners": listeners_main})
