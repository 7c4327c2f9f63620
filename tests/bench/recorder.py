"""What the flight recorder costs: `./course run python tests/bench/recorder.py`.

A call with a connection of its own, one over a kept connection, and a published message, where neither end is
recorded and where both are; and an event by itself. Each way has processes of its own, which take turns;
clients and servers are pinned to a core each. Printed is each one's best run, by the lower quartile of its
calls: what else the machine does makes times longer, and never shorter.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time

import rospy

from course_pkg.graph import PrivateMaster
from course_pkg.graph.trace import Recorder

BAR, EVENT_BAR = 1.03, 5.0  # of a call with a connection of its own; microseconds
NODE = """
import json, os, statistics, sys, time
import rospy
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from course_pkg.graph import guard_against_idle_connections, prepare_node
way, core, calls = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
rospy.init_node(f"{way}_{'client' if calls else 'server'}", disable_signals=True)
prepare_node() if way == "recorded" else guard_against_idle_connections()
os.sched_setaffinity(0, {core})
def quick(action, repeats):
    times = []
    for _ in range(repeats + 50):
        started = time.perf_counter()
        action()
        times.append(time.perf_counter() - started)
    return statistics.quantiles(times[50:], n=4)[0]
"""
SERVER = (
    NODE
    + """
rospy.Service(way, Trigger, lambda request: (True, ""))
time.sleep(1000)
"""
)
CLIENT = (
    NODE
    + """
fresh, kept = rospy.ServiceProxy(way, Trigger), rospy.ServiceProxy(way, Trigger, persistent=True)
alone = rospy.Publisher("alone", Float64, queue_size=100)
heard = rospy.Publisher("heard", Float64, queue_size=100)
rospy.Subscriber("heard", Float64, lambda message: None)
while not heard.get_num_connections():
    time.sleep(0.01)
print(json.dumps({
    "call, a connection each": quick(fresh, calls),
    "call, a connection kept": quick(kept, calls),
    "message that nobody hears": quick(lambda: alone.publish(1.0), calls),
    "message to one": quick(lambda: heard.publish(1.0), calls),
}))
"""
)
Figures = dict[str, float]


def main() -> int:
    """Print all figures; fail when one misses its bar."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=1000)
    parser.add_argument("--runs", type=int, default=7)
    options = parser.parse_args()
    cores = sorted(os.sched_getaffinity(0))
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        servers = {way: started(way, cores[-1]) for way in ("bare", "recorded")}
        runs: list[tuple[Figures, Figures]] = []
        for _ in range(options.runs):
            bare, recorded = (figures(way, cores[0], options.calls) for way in servers)
            runs.append((bare, recorded))
        for server in servers.values():
            server.kill()
            server.wait()
    ratio, cost = shown(runs), event()
    print(f"an event by itself: {cost:.2f} µs, bar {EVENT_BAR:g}")
    return int(ratio > BAR or cost > EVENT_BAR)


def started(way: str, core: int) -> subprocess.Popen[bytes]:
    """Start a server whose calls are recorded, or are not."""
    server = subprocess.Popen([sys.executable, "-c", SERVER, way, str(core), "0"])
    rospy.wait_for_service(way, timeout=20)
    return server


def figures(way: str, core: int, calls: int) -> Figures:
    """Return what one process measures, in s."""
    command = [sys.executable, "-c", CLIENT, way, str(core), str(calls)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    found: Figures = json.loads(done.stdout.splitlines()[-1])
    return found


def shown(runs: list[tuple[Figures, Figures]]) -> float:
    """Print what each costs; return the ratio for a call with a connection of its own."""
    ratios = []
    for name in runs[0][0]:
        bare, recorded = (1e6 * min(run[end][name] for run in runs) for end in (0, 1))
        ratios.append(recorded / bare)
        print(f"{name}: bare {bare:.1f} µs, recorded {recorded:.1f} µs, ratio {ratios[-1]:.3f}")
    print(f"bar for the first: {BAR}")
    return ratios[0]


def event() -> float:
    """Return how long it takes to take down the beginning and the end of something (µs)."""
    recorder = Recorder()
    rounds = []
    for _ in range(50):
        began = time.perf_counter()
        for _ in range(1000):
            recorder.end(recorder.begin("handler", "/service", "/client", []))
        rounds.append((time.perf_counter() - began) / 1000)
    return 1e6 * statistics.median(rounds)


if __name__ == "__main__":
    sys.exit(main())
