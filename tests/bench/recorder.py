"""What the flight recorder costs: `./course run python tests/bench/recorder.py`.

A call with a connection of its own and one over a kept connection, with neither end recorded and with both;
a published message; and an event by itself. Client and servers are pinned to a core each, the two ways
alternate.
"""

from __future__ import annotations

import argparse
import inspect
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import rospy
from rospy.impl import tcpros_pubsub, tcpros_service
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.topics import _PublisherImpl
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from course_pkg.graph import PrivateMaster, prepare_node
from course_pkg.graph.trace import Recorder

BAR, EVENT_BAR = 1.03, 5.0  # of a call with a connection of its own; microseconds
SERVER = """
import os, sys, rospy
from std_srvs.srv import Trigger
from course_pkg.graph import guard_against_idle_connections, prepare_node
os.sched_setaffinity(0, {int(sys.argv[2])})
rospy.init_node("server_" + sys.argv[1])
prepare_node() if sys.argv[1] == "recorded" else guard_against_idle_connections()
rospy.Service(sys.argv[1], Trigger, lambda request: (True, ""))
rospy.spin()
"""
TAPPED = (
    (tcpros_service, "TCPROSTransport", TCPROSTransport),
    (tcpros_service.ServiceProxy, "call", None),
    (tcpros_service.ServiceProxy, "_get_service_uri", None),
    (tcpros_pubsub, "TCPROSTransport", TCPROSTransport),
    (_PublisherImpl, "publish", None),
)


def main() -> int:
    """Print all figures; fail when one misses its bar."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=2000)
    calls = parser.parse_args().calls
    cores = sorted(os.sched_getaffinity(0))
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        rospy.init_node("bench_recorder", disable_signals=True)
        prepare_node()
        servers = [started(name, cores[-1]) for name in ("bare", "recorded")]
        os.sched_setaffinity(0, {cores[0]})
        ratios = {way: compared(way, calls) for way in ("one each", "persistent")}
        published()
        for server in servers:
            server.terminate()
            server.wait()
    cost = event()
    print(f"event        {cost:.2f} µs (bar {EVENT_BAR:g})")
    return int(ratios["one each"] > BAR or cost > EVENT_BAR)


def started(name: str, core: int) -> subprocess.Popen[bytes]:
    """Start a server whose calls are recorded, or are not."""
    server = subprocess.Popen([sys.executable, "-c", SERVER, name, str(core)])
    rospy.wait_for_service(name, timeout=20)
    return server


@contextmanager
def unrecorded() -> Iterator[None]:
    """Have this process's rospy as it was, for the block."""
    tapped = [(owner, name, getattr(owner, name)) for owner, name, _ in TAPPED]
    for owner, name, bare in TAPPED:
        setattr(owner, name, bare or inspect.unwrap(getattr(owner, name)))
    try:
        yield
    finally:
        for owner, name, method in tapped:
            setattr(owner, name, method)


def compared(way: str, calls: int) -> float:
    """Print the medians of both, called in turns in blocks of 20; return the median of the blocks' ratios."""
    persistent = way == "persistent"
    with unrecorded():
        bare = rospy.ServiceProxy("bare", Trigger, persistent=persistent)
        timed(bare, 50)
    recorded = rospy.ServiceProxy("recorded", Trigger, persistent=persistent)
    timed(recorded, 50)
    blocks: list[tuple[float, float]] = []
    for number in range(calls // 20):
        after = timed(recorded, 20) if number % 2 else []  # each goes first in every other block
        with unrecorded():
            before = timed(bare, 20)
        blocks.append((quick(before), quick(after or timed(recorded, 20))))
    ratio = statistics.median(second / first for first, second in blocks)
    medians = [1000 * statistics.median(each) for each in zip(*blocks, strict=True)]
    added = 1e6 * statistics.median(second - first for first, second in blocks)
    print(
        f"{way:12} bare {medians[0]:.3f} ms, recorded {medians[1]:.3f} ms, both ends add {added:.0f} µs, "
        f"ratio {ratio:.3f}" + ("" if persistent else f" (bar {BAR})")
    )
    return ratio


def published() -> None:
    """Print what a message costs that goes to one subscriber, and one that nobody hears."""
    for label, listeners in (("unheard", 0), ("to one", 1)):
        publisher = rospy.Publisher(f"numbers_{listeners}", Float64, queue_size=100)
        for _ in range(listeners):
            rospy.Subscriber(f"numbers_{listeners}", Float64, lambda _: None)
        while publisher.get_num_connections() < listeners:
            time.sleep(0.01)
        blocks = []
        for _ in range(50):
            with unrecorded():
                first = quick(timed(partial(publisher.publish, 1.0), 40))
            blocks.append((first, quick(timed(partial(publisher.publish, 1.0), 40))))
        bare, recorded = (1e6 * statistics.median(each) for each in zip(*blocks, strict=True))
        print(f"publish      {label}: bare {bare:.1f} µs, recorded {recorded:.1f} µs")


def event() -> float:
    """Return how long it takes to take down the beginning and the end of something (µs)."""
    recorder = Recorder()

    def one() -> None:
        recorder.end(recorder.begin("handler", "/service", "/client", []))

    return 1e6 * statistics.median(sum(timed(one, 1000)) / 1000 for _ in range(50))


def quick(times: list[float]) -> float:
    """Return the lower quartile: what else the machine does makes times longer, and never shorter."""
    return statistics.quantiles(times, n=4)[0]


def timed(action: Callable[[], object], repeats: int) -> list[float]:
    """Return how long each of the repeats took, in s."""
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        action()
        times.append(time.perf_counter() - started)
    return times


if __name__ == "__main__":
    sys.exit(main())
