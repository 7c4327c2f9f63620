"""A program steps onto the graph: bounded where it can be, and to be ended while it waits."""

from __future__ import annotations

import sys

import rospy

from course_pkg.graph.master import await_master
from course_pkg.graph.preparation import prepare_node


def step_onto_graph(name: str) -> bool:
    """Be the node `name` as soon as there is a master; return False when Ctrl-C came before that.

    Raises MalformedMasterUri and NotAMaster.
    """
    try:
        await_master(rospy.logwarn)
    except KeyboardInterrupt:
        return False
    rospy.init_node(name)
    prepare_node()
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
        sys.exit(
            f"{rospy.resolve_name(name)} is {given!r}, and has to be a number from {least:g} to {most:g}."
        )
    return value
