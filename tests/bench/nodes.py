"""Measures the turtle simulator and the faults of BreakIt.

usage: ./course run python -m tests.bench.nodes rates|fuzz|faults [OPTION …]
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import pairwise
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim.srv import Spawn, TeleportAbsolute

from course_pkg.faults import Stage, named, names
from course_pkg.ros import NodeProcess, PrivateMaster, join, look
from tests.bench.commands import run_command
from tests.faults.surroundings import Surroundings
from tests.turtlesim.fuzz import Fuzzer, resident, sane

# rates: measures the CPU time of the simulator, and the regularity of the simulator's ticks. The benchmark
# needs an idle machine. The limits are for moving turtles with subscribers. The rate is 62.5 Hz with an error
# of at most 1 %, and 99 % of the gaps are at most 24 ms (in 20 s). The simulator uses at most 4 % of a core
# with one turtle, and at most 15 % with 12 turtles. The services spawn, teleport and reset respond within 18
# ms.

TURTLES = 12


def rates_main() -> None:
    """Print each measured number and its limit."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    seconds = parser.parse_args().seconds
    join("bench")
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as simulator:
        simulator.wait_for_service("/spawn")
        measure(simulator, 1, seconds)
        answers()
        spawn = rospy.ServiceProxy("/spawn", Spawn)
        for number in range(2, TURTLES + 1):
            spawn(5, 5, number, "")
        measure(simulator, TURTLES, seconds)


def measure(simulator: NodeProcess, turtles: int, seconds: float) -> None:
    """Print the rate, the gaps and the CPU time."""
    names = [f"/turtle{number}" for number in range(1, turtles + 1)]
    arrivals: deque[float] = deque()
    with ExitStack() as open_:
        for name in names:
            hear = (lambda _: arrivals.append(time.monotonic())) if name == "/turtle1" else (lambda _: None)
            for topic, callback in ((f"{name}/pose", hear), (f"{name}/color_sensor", lambda _: None)):
                subscriber = rospy.Subscriber(topic, rospy.AnyMsg, callback, tcp_nodelay=True)
                open_.callback(subscriber.unregister)
        open_.enter_context(driving(names))
        while len(arrivals) < 100:
            time.sleep(0.01)
        arrivals.clear()
        pid, began = pid_of(simulator), time.monotonic()
        before = processor_time(pid)
        time.sleep(seconds)
        load = (processor_time(pid) - before) / (time.monotonic() - began)
    gaps = sorted(later - earlier for earlier, later in pairwise(arrivals))
    rate = 1 / statistics.fmean(gaps)
    p99 = gaps[int(len(gaps) * 0.99)] * 1000
    limit = 4 if turtles == 1 else 15
    print(
        f"{turtles:2} turtles: {rate:.2f} Hz (62.5 within 1 %), p99 gap {p99:.1f} ms (≤ 24), "
        f"{100 * load:.1f} % of a core (≤ {limit})"
    )


@contextmanager
def driving(names: list[str]) -> Iterator[None]:
    """Move all turtles in circles during the `with` block, with 10 velocity messages per second."""
    publishers = [rospy.Publisher(f"{name}/cmd_vel", Twist, queue_size=1) for name in names]
    order = Twist()
    order.linear.x, order.angular.z = 2.0, 1.5
    done = threading.Event()

    def drive() -> None:
        while not done.wait(0.1):
            for publisher in publishers:
                publisher.publish(order)

    thread = threading.Thread(target=drive)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()
        for publisher in publishers:
            publisher.unregister()


def answers(count: int = 40) -> None:
    """Print the median duration of a call for each service."""
    spawn, reset = rospy.ServiceProxy("/spawn", Spawn), rospy.ServiceProxy("/reset", Empty)
    teleport = rospy.ServiceProxy("/turtle1/teleport_absolute", TeleportAbsolute)
    calls: dict[str, Callable[[], object]] = {
        "spawn": lambda: spawn(3, 3, 0, ""),
        "teleport": lambda: teleport(3, 3, 0),
        "reset": lambda: reset(),
    }
    times: dict[str, list[float]] = {label: [] for label in calls}
    for turn in range(count):
        for label, call in calls.items():
            # The pause varies so that the calls arrive at different times within a tick.
            time.sleep(0.001 * (turn % 17))
            started = time.monotonic()
            call()
            times[label].append((time.monotonic() - started) * 1000)
    shown = ", ".join(f"{label} {statistics.median(each):.1f}" for label, each in times.items())
    print(f"answers, median ms (≤ 18): {shown}")


def pid_of(simulator: NodeProcess) -> int:
    """Return the process id of the node."""
    assert look().node("/turtlesim")
    return int(simulator.pid)


def processor_time(pid: int) -> float:
    """Return the CPU time of a process in s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


# fuzz: sends 10,000 random calls and messages to the simulator. The benchmark prints whether the node still
# runs, whether the node's state is consistent, and how much memory the node uses.

BLOCKS = 10


def fuzz_main() -> None:
    """Make random calls in ten blocks, and check the node after each block."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--deeds", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    node = join("fuzz")
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as simulator:
        simulator.wait_for_service("/spawn")
        fuzzer = Fuzzer(node, options.seed)
        for block in range(1, BLOCKS + 1):
            started = time.monotonic()
            for _ in range(options.deeds // BLOCKS):
                fuzzer.step()
            sane(node)
            took, memory = time.monotonic() - started, resident(simulator.pid)
            done = block * options.deeds // BLOCKS
            print(
                f"{done:6} actions, {fuzzer.refused} calls refused, {took:.1f} s, {memory:.1f} MiB",
                flush=True,
            )
    print("the node still ran, and its world was consistent, after each block")


# faults: measures the time to cause and undo each fault of BreakIt, and checks whether the graph is restored.
# usage: nodes.py faults [ROUNDS] [FAULT …] For each fault, the benchmark prints the median and the maximum
# duration (s), and how often a node, topic, service, process, listening port or environment variable
# remained. For comparison, the benchmark also measures the start and the end of a plain node.

BOUND = 3.0  # The benchmark counts the rounds that take longer than this time in s.
BARE = """
import rospy
from std_srvs.srv import Trigger
rospy.init_node("bare")
rospy.Service("bare", Trigger, lambda request: (True, ""))
rospy.spin()
"""


def one_round(name: str) -> float:
    """Cause and undo one fault, and return the duration in s."""
    began = time.monotonic()
    stage = Stage(named(name))
    stage.cause()
    stage.undo()
    return time.monotonic() - began


def bare_round() -> float:
    """Start a node, wait for its service, and end the node; return the duration in s."""
    began = time.monotonic()
    process = NodeProcess([sys.executable, "-c", BARE])
    process.wait_for_service("/bare")
    process.stop(grace=0)
    return time.monotonic() - began


def measured(label: str, rounds: int, turn: Callable[[], float]) -> tuple[float, float, int]:
    """Call a function several times, and measure the duration of each call.

    Print and return the median and the maximum duration in s, and the number of rounds that changed the
    graph.
    """
    before, times, changed = Surroundings(), [], 0
    for _ in range(rounds):
        times.append(turn())
        changed += bool(before.left_behind())
    median, longest = statistics.median(times), max(times)
    over = sum(each > BOUND for each in times)
    print(
        f"{label:22} median {median:5.2f} s  max {longest:5.2f} s  over {over}  left behind {changed}",
        flush=True,
    )
    return median, longest, changed


def faults_main() -> None:
    """Measure the faults on a private master, and print the results."""
    rounds = next((int(word) for word in sys.argv[1:] if word.isdigit()), 50)
    chosen = [word for word in sys.argv[1:] if not word.isdigit()]
    with PrivateMaster() as master:
        os.environ.update(ROS_MASTER_URI=master.uri, ROS_HOSTNAME="localhost")
        bare, _, _ = measured("a bare node", rounds, bare_round)
        all_of_them = [
            measured(name, rounds, lambda name=name: one_round(name)) for name in chosen or names()
        ]
    medians, maxima, changes = zip(*all_of_them, strict=True)
    typical = statistics.median(medians)
    print(
        f"{len(all_of_them)} faults, {rounds} times each: median of medians {typical:.2f} s, "
        f"{typical / bare:.1f} of a bare node; longest {max(maxima):.2f} s; left behind {sum(changes)} times"
    )


if __name__ == "__main__":
    run_command({"rates": rates_main, "fuzz": fuzz_main, "faults": faults_main})
