"""Compares the first and the second start of `course lab` for a new user of a shared installation.

Arguments: `PREFIX [RUNS]`. PREFIX is the folder into which `./course install --prefix PREFIX` has installed
the course. Each run starts as a new user, with an empty home folder and an empty browser cache. For the first
start and for the second start, the program prints the time from the command to a page with a rendered
notebook and an idle kernel. The program also prints the size of the user's files. If root starts the program,
the new user is the account `nobody`.
"""

from __future__ import annotations

import os
import shutil
import statistics
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.bench.lab.start import FLAGS, STEPS, started, times_of_start

RATIO, SIZE = 1.3, 5.0  # maximum ratio of the durations (first start / second start), and maximum size in MB
NOBODY = 65534
DROP = ("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups")


@contextmanager
def installed(program: Path, _notebook: Path, home: Path) -> Iterator[str]:
    """Run `course lab` of the installation as a new user; yield the address of the first chapter."""
    command = [*(DROP if os.geteuid() == 0 else ()), program, "lab", "--no-browser"]
    variables = {"HOME": str(home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    with started(command, variables, home) as address:
        yield address


def new_user(program: Path) -> tuple[list[float], list[float], float]:
    """Start the lab twice as a new user.

    Return the durations of the first and the second start in s, and the size of the user's files in MB.
    """
    with tempfile.TemporaryDirectory(dir="/tmp") as folder, sync_playwright() as playwright:
        home = Path(folder, "home")
        home.mkdir()
        if os.geteuid() == 0:
            Path(folder).chmod(0o711)
            os.chown(home, NOBODY, NOBODY)
        starts = []
        for _ in range(2):
            context = playwright.chromium.launch_persistent_context(
                Path(folder, "profile"), executable_path=shutil.which("chromium"), args=FLAGS, headless=True
            )
            starts.append(times_of_start(context, partial(installed, program), home, home))
            context.close()
        size = sum(path.stat().st_blocks * 512 for path in home.rglob("*")) / 1e6
        return starts[0], starts[1], size


def first_start_main() -> int:
    """Measure each new user, and print the medians."""
    program = Path(sys.argv[1], "current", "course", "course")
    runs = int(sys.argv[2]) if sys.argv[2:] else 5
    first, second, sizes = zip(*(new_user(program) for _ in range(runs)), strict=True)
    print(f"{'s after the command':22}", *(f"{name:>18}" for name in STEPS))
    for name, rows in (("first start", first), ("second start", second)):
        print(f"{name:22}", *(f"{statistics.median(each):18.2f}" for each in zip(*rows, strict=True)))
    ratio = statistics.median(row[-1] for row in first) / statistics.median(row[-1] for row in second)
    print(f"first / second start: {ratio:.2f} (bar {RATIO}): {'met' if ratio <= RATIO else 'MISSED'}")
    print(
        f"the user's files: {max(sizes):.1f} MB (bar {SIZE:g}): {'met' if max(sizes) <= SIZE else 'MISSED'}"
    )
    return 0 if ratio <= RATIO and max(sizes) <= SIZE else 1
