"""What it costs to open the type browser: with what this machine has, and with hundreds of types more.

The peer is `rossrv list`, which lists the same service types in a terminal.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from course_pkg.graph import PrivateMaster
from course_pkg.panels import TypeBrowser

BAR = 100.0  # ms to open, after the import, with what the distribution has
PACKAGES, TYPES = 60, 10
RUNS = 9
MANIFEST = "<package format='2'><name>{}</name><version>1.0.0</version></package>"


def fill(folder: Path) -> None:
    """Write packages with service and message types."""
    for number in range(PACKAGES):
        root = folder / f"bulk_{number}"
        for half, text in (("srv", "geometry_msgs/Pose goal\n---\nbool done\n"), ("msg", "float64 x\n")):
            (root / half).mkdir(parents=True)
            for short in range(TYPES):
                (root / half / f"Type{short}.{half}").write_text(text)
        (root / "package.xml").write_text(MANIFEST.format(root.name))


def median(do: Callable[[], object]) -> float:
    """Return the median time (ms) of something."""
    times = []
    for _ in range(RUNS):
        began = time.perf_counter()
        do()
        times.append(1000 * (time.perf_counter() - began))
    return statistics.median(times)


def report(what: str) -> float:
    """Print the figures for the path as it is now, and return the time to open a browser with a type."""
    first = time.perf_counter()
    TypeBrowser("std_srvs/SetBool")
    first = 1000 * (time.perf_counter() - first)
    empty, opened = median(TypeBrowser), median(lambda: TypeBrowser("std_srvs/SetBool"))
    peer = median(lambda: subprocess.run(["rossrv", "list"], check=True, stdout=subprocess.DEVNULL))
    print(f"{what}: first {first:.0f} ms, then TypeBrowser() {empty:.0f} ms, with a type {opened:.0f} ms")
    print(f"  rossrv list: {peer:.0f} ms; ratio {empty / peer:.2f}")
    return first


def main() -> int:
    """Print the figures; fail when the first browser misses its bar."""
    with PrivateMaster() as master, tempfile.TemporaryDirectory() as folder:
        os.environ.update(ROS_MASTER_URI=master.uri, ROS_HOSTNAME="localhost")
        first = report("this machine")
        fill(Path(folder))
        os.environ["ROS_PACKAGE_PATH"] = f"{folder}:{os.environ['ROS_PACKAGE_PATH']}"
        report(f"{PACKAGES * TYPES} services and as many messages more")
    print(f"bar for the first: {BAR:.0f} ms")
    return int(first > BAR)


if __name__ == "__main__":
    sys.exit(main())
