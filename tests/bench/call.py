"""What a bounded call costs beside a bare one: `./course run python tests/bench/call.py`.

Both call the same server, in turns, in blocks; printed are the medians, their ratio, and how they spread.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import rospy
from course_pkg.srv import geometry

from course_pkg.graph import BoundedProxy, NodeProcess, join, look


def main() -> None:
    """Measure calls with a connection each, calls over a kept one, and looks at a graph."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=1000)
    calls = parser.parse_args().calls
    node = join("bench")
    server = node.run("course_pkg", "server")
    server.wait_for_service("/getGeometry")
    node.subscribe("/rosout", "rosgraph_msgs/Log")
    for persistent in (False, True):
        bare = rospy.ServiceProxy("/getGeometry", geometry, persistent=persistent)
        bounded = node.caller("/getGeometry", geometry, persistent=persistent)
        compare("persistent" if persistent else "one each", bare, bounded, calls)
    for count in (1, 20):
        looks(count)
    node.leave()


def compare(label: str, bare: rospy.ServiceProxy, bounded: BoundedProxy, calls: int) -> None:
    """Print medians (ms) of both, called in turns."""
    for proxy in (bare, bounded):
        timed(lambda proxy=proxy: proxy(1.2, 5.2, 8.9), 50)
    blocks: tuple[list[float], list[float]] = ([], [])
    for _ in range(calls // 20):
        for proxy, times in zip((bare, bounded), blocks, strict=True):
            times += timed(lambda proxy=proxy: proxy(1.2, 5.2, 8.9), 20)
    first, second = (statistics.median(times) for times in blocks)
    print(f"{label:12} bare {first:.3f} ms, bounded {second:.3f} ms, ratio {second / first:.3f}")


def looks(count: int) -> None:
    """Print how long a look at a graph of `count` nodes takes."""
    processes = [NodeProcess.rosrun("course_pkg", "pulse", name=f"pulse_{number}") for number in range(count)]
    for number, process in enumerate(processes):
        process.wait_for_service(f"/pulse_{number}/get_loggers", timeout=60)
    times = timed(look, 30)
    middle, worst = statistics.median(times), max(times)
    print(f"look at {len(look().nodes)} nodes: median {middle:.1f} ms, worst {worst:.1f} ms")
    for process in processes:
        process.interrupt()
    for process in processes:
        process.stop()


def timed(action: Callable[[], object], repeats: int) -> list[float]:
    """Return how long each of the repeats took, in ms."""
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        action()
        times.append((time.perf_counter() - started) * 1000)
    return times


if __name__ == "__main__":
    main()
