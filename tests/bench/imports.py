"""What `import course_pkg`, and a notebook's imports, cost beyond rospy: `python tests/bench/imports.py`."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

ROUNDS = 21
BAR = 60.0  # ms
PEER = "import rospy"
STATEMENTS = {
    "course_pkg": "import rospy, course_pkg",
    "join": "import rospy; from course_pkg import join",
    "check": "import rospy; from course_pkg import check",
    "join, check, predict, panels": (
        "import rospy; from course_pkg import join, check, predict, ServicePanel, GraphPanel"
    ),
    "ipywidgets, for comparison": "import rospy, ipywidgets",
}


def milliseconds(statement: str) -> float:
    """Return how long a fresh interpreter takes to run `statement`, in ms."""
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", statement], check=True)
    return (time.perf_counter() - start) * 1000


def main() -> None:
    """Take turns, so that a busy moment hits all alike, and print medians beyond the peer."""
    taken: dict[str, list[float]] = {name: [] for name in STATEMENTS}
    for _ in range(ROUNDS):
        peer = milliseconds(PEER)
        for name, statement in STATEMENTS.items():
            taken[name].append(milliseconds(statement) - peer)
    for name, times in taken.items():
        print(f"{name}: {statistics.median(times):+.0f} ms beyond rospy")
    print(f"bar for course_pkg: {BAR:.0f} ms")


if __name__ == "__main__":
    main()
