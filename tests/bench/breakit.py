"""How long each fault of the lab takes to be caused and undone, and whether the graph is as before.

usage: breakit.py [ROUNDS] [FAULT …]

Per fault the median and the longest of cause and undo together (s), and how often something was left behind:
a node, a topic, a service, a process, a listening port, a variable of the environment. Beside them, in the
same run, what starting and ending a bare node takes, of which no fault with a server can be faster.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Callable

from course_pkg.faults import Stage, named, names
from course_pkg.graph import NodeProcess, PrivateMaster
from tests.faults.surroundings import Surroundings

BOUND = 3.0  # s
BARE = """
import rospy
from std_srvs.srv import Trigger
rospy.init_node("bare")
rospy.Service("bare", Trigger, lambda request: (True, ""))
rospy.spin()
"""


def one_round(name: str) -> float:
    """Cause and undo one fault; return how long that took, in s."""
    began = time.monotonic()
    stage = Stage(named(name))
    stage.cause()
    stage.undo()
    return time.monotonic() - began


def bare_round() -> float:
    """Start a node, wait for its service, and end it."""
    began = time.monotonic()
    process = NodeProcess([sys.executable, "-c", BARE])
    process.wait_for_service("/bare")
    process.stop(grace=0)
    return time.monotonic() - began


def measured(label: str, rounds: int, turn: Callable[[], float]) -> tuple[float, float, int]:
    """Run `turn` for some rounds, print and return the median, the longest, and how often not as before."""
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


def main(rounds: int, chosen: list[str]) -> None:
    """Measure on a master of this run's own."""
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
    given = sys.argv[1:]
    main(
        int(given[0]) if given and given[0].isdigit() else 50, [name for name in given if not name.isdigit()]
    )
