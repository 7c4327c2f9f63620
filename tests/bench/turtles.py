"""What the simulator costs and how evenly it ticks: `./course run python tests/bench/turtles.py`.

Bars: 62.5 Hz within 1 % and a p99 gap of at most 24 ms with 1 and 12 turtles over 20 s; at most 4 % of a
core with one turtle and 15 % with 12 that are listened to and driven; spawn, teleport and reset answer
within 18 ms. Needs an idle machine.
"""

from __future__ import annotations

import argparse
import os
import statistics
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

from course_pkg.graph import NodeProcess, join, look

TURTLES = 12


def main() -> None:
    """Print every figure beside its bar."""
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
    """Print rate, gaps and processor time while every turtle is heard and driven."""
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
    """Have every turtle go round, told 10 times a second."""
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
    """Print how long the services take."""
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
            time.sleep(0.001 * (turn % 17))  # a call may come at any moment of a tick
            started = time.monotonic()
            call()
            times[label].append((time.monotonic() - started) * 1000)
    shown = ", ".join(f"{label} {statistics.median(each):.1f}" for label, each in times.items())
    print(f"answers, median ms (≤ 18): {shown}")


def pid_of(simulator: NodeProcess) -> int:
    """Return the process that is the node."""
    assert look().node("/turtlesim")
    return int(simulator.pid)


def processor_time(pid: int) -> float:
    """Return the processor time (s) that a process has used."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main()
