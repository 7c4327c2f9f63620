"""A program steps onto the graph: bounded where it can be, and to be ended while it waits."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable

import rospy

from course_pkg.graph.master import await_master
from course_pkg.graph.preparation import prepare_node

ENDINGS = (signal.SIGINT, signal.SIGTERM)
LOOK = 0.02  # s between looks


def step_onto_graph(name: str) -> bool:
    """Be the node `name` as soon as there is a master; return False when Ctrl-C came before that.

    Raises MalformedMasterUri and NotAMaster.
    """
    try:
        await_master(rospy.logwarn)
    except KeyboardInterrupt:
        return False
    # Ctrl-C is put off: while rospy begins it holds locks that its end needs, too. A mask does it, where
    # rospy installs handlers of its own.
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDINGS)
    try:
        rospy.init_node(name)
        prepare_node()
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDINGS)
    return True


def number_parameter(name: str, default: float, least: float, most: float) -> float:
    """Return the number that a program was started with, such as `_rate:=5`; end it when that is none.

    It has to be from `least` to `most`, in the unit of the parameter.
    """
    given = rospy.get_param(name, default)
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = float("nan")
    if not least <= value <= most:
        allowed = f"a number from {least:g} to {most:g}"
        sys.exit(f"{rospy.resolve_name(name)} is {given!r}, and has to be {allowed}.")
    return value


def wait_until(condition: Callable[[], object], seconds: float) -> bool:
    """Wait for `condition`, at most `seconds`; return False when they are over, or the node is shut down."""
    deadline = time.monotonic() + seconds
    while not (met := bool(condition())) and time.monotonic() < deadline and not rospy.is_shutdown():
        time.sleep(LOOK)
    return met
