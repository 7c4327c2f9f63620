"""What a call through the service panel costs over a bare rospy proxy, both without a persistent connection.

The panel's part is what happens between a click and the page: texts to values, the call, the response to
lines. Client and server are pinned to a core each, and the two ways alternate.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import time
from collections.abc import Callable

import rospy
from course_pkg.srv import geometry

from course_pkg.graph import PrivateMaster, join
from course_pkg.panels import ServicePanel

BAR = 1.15


def timed(action: Callable[[], object]) -> float:
    """Return how long an action takes (ms)."""
    began = time.perf_counter()
    action()
    return 1000 * (time.perf_counter() - began)


def compare(calls: int) -> tuple[float, float]:
    """Return the medians (ms) of the bare proxy and of the panel."""
    node = join("bench_panel_call")
    server = node.run("course_pkg", "server")
    server.wait_for_service("/getGeometry", timeout=20)
    cores = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(server.pid, {cores[-1]})
    os.sched_setaffinity(0, {cores[0]})
    proxy = rospy.ServiceProxy("/getGeometry", geometry)
    panel = ServicePanel("/getGeometry")
    panel.fill(length=1.2, width=5.2, height=8.9)
    ways = {"bare": lambda: proxy(1.2, 5.2, 8.9), "panel": lambda: panel._model.call("5")}
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(calls):
        for name, way in ways.items():
            times[name].append(timed(way))
    panel.close()
    node.leave()
    return statistics.median(times["bare"][calls // 10 :]), statistics.median(times["panel"][calls // 10 :])


def main() -> int:
    """Print the ratio of each run; fail when the median of them misses the bar."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=1000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    ratios = []
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        for _ in range(options.runs):
            bare, panel = compare(options.calls)
            ratios.append(panel / bare)
            sys.stdout.write(f"bare proxy {bare:.3f} ms, panel {panel:.3f} ms, ratio {panel / bare:.3f}\n")
    ratio = statistics.median(ratios)
    sys.stdout.write(f"median ratio {ratio:.3f}, bar {BAR}\n")
    return int(ratio > BAR)


if __name__ == "__main__":
    sys.exit(main())
