"""The site: how fast it is built, what its pages weigh, how soon the first panel is there.

`./course site` must have run every chapter before. The speed is held against `jupyter nbconvert --to html`
of the same 14 executed notebooks, in turns; where the course has fewer chapters, some are built twice.
"""

from __future__ import annotations

import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from gzip import compress
from itertools import cycle, islice
from pathlib import Path

from playwright.sync_api import sync_playwright

from course_pkg.authoring.shelf import Shelf, text_of
from course_pkg.site.runs import Runs

PAGES = 14
ROUNDS = 5
LOADS = 5
BUILD = """
import sys
from pathlib import Path
from course_pkg.site.command import without_slow_import
with without_slow_import():
    from course_pkg.authoring.shelf import Shelf
    from course_pkg.site.build import write_site
    from course_pkg.site.settings import Settings
    write_site(Settings(Path(sys.argv[2]), execute=False), Shelf(Path(sys.argv[1])))
"""
FIRST_PANEL = """
window.firstPanel = new Promise((resolve) => new MutationObserver((_changes, observer) => {
  if (!document.querySelector(".ros-panel")) return;
  observer.disconnect();
  requestAnimationFrame(() => requestAnimationFrame(() => resolve(performance.now())));
}).observe(document, { childList: true, subtree: true }));
"""


def main() -> None:
    """Measure, and print."""
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        root = Path(folder)
        write_notebooks(root)
        speed(root)
        weights(root / "site")
        first_panels(root / "site")


def write_notebooks(root: Path) -> None:
    """Write 14 executed notebooks: the chapters as they ran last, the first ones twice."""
    runs, solutions = Runs(), Shelf().solutions()
    (root / "solutions").mkdir()
    for number, path in enumerate(islice(cycle(solutions), PAGES)):
        notebook = runs.latest(path)
        if notebook is None:
            sys.exit(f"{path.stem} has not run yet: type ./course site")
        (root / "solutions" / f"{number:02}{path.name[2:]}").write_text(text_of(notebook), "utf-8")
    size = sum(len(json.dumps(path.read_text("utf-8"))) for path in (root / "solutions").iterdir())
    print(f"{PAGES} notebooks, {size / 1000:.0f} kB, of {len(solutions)} chapters")


def speed(root: Path) -> None:
    """Build both in turns, each as a process of its own."""
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
    took = turns({"course site": lambda: run(ours), "nbconvert": lambda: run([*theirs, *notebooks])})
    site, peer = took["course site"], took["nbconvert"]
    print(f"build: {site:.2f} s; jupyter nbconvert --to html: {peer:.2f} s; ratio {peer / site:.1f}")


def turns(contestants: dict[str, Callable[[], None]]) -> dict[str, float]:
    """Return the median time (s) of each over the rounds, in which they take turns."""
    took: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(ROUNDS):
        for name, contestant in contestants.items():
            began = time.perf_counter()
            contestant()
            took[name].append(time.perf_counter() - began)
    return {name: statistics.median(times) for name, times in took.items()}


def run(command: Sequence[str]) -> None:
    """Run a command to its end."""
    subprocess.run(command, check=True, capture_output=True)


def weights(site: Path) -> None:
    """Print what is each page's own, and what all share."""
    own = [path.stat().st_size for path in site.glob("[0-9]*.html")]
    packed = [len(compress(path.read_bytes())) for path in site.glob("[0-9]*.html")]
    print(f"own part: median {statistics.median(own) / 1000:.1f} kB, most {max(own) / 1000:.1f} kB; ", end="")
    print(f"gzipped: median {statistics.median(packed) / 1000:.1f} kB")
    shared = {path.name: len(compress(path.read_bytes())) for path in (site / "assets").iterdir()}
    loaded = {name: size for name, size in shared.items() if name not in ("texts.js", "LICENSES.txt")}
    print(f"shared part, gzipped: {sum(loaded.values()) / 1000:.1f} kB {loaded}; ", end="")
    print(f"texts of the search, loaded when one begins: {shared['texts.js'] / 1000:.1f} kB")


def first_panels(site: Path) -> None:
    """Print how long after the start of the navigation the first panel of a page was painted."""
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


if __name__ == "__main__":
    main()
