"""The node `spawn_turtle`: waits for a simulator for at most 5 s, spawns MyTurtle at (3, 3), and ends."""

from __future__ import annotations

import sys

import rospy
from turtlesim.srv import Spawn

from course_pkg.ros import prepare_node

NAME = "MyTurtle"
PLACE = (3.0, 3.0, 0.0)
TIMEOUT = 5.0  # The time is in s.


def main() -> None:
    """Spawn the turtle and log its name; if this fails, the exit status is 1."""
    rospy.init_node("spawn_turtle")
    prepare_node()
    spawn_or_exit()


def spawn_or_exit() -> None:
    """Spawn MyTurtle at (3, 3) as soon as a simulator is running; if this fails, the exit status is 1."""
    require("spawn")
    try:
        response = rospy.ServiceProxy("spawn", Spawn)(*PLACE, NAME)
    except rospy.ServiceException as error:
        sys.exit(
            f"{NAME} was not spawned: {error}. Is there already a turtle with this name? Read the "
            "simulator's log."
        )
    rospy.loginfo("Spawned a turtle named %s", response.name)


def require(service: str) -> None:
    """Wait for a service; if it does not start in time, exit with status 1."""
    try:
        rospy.wait_for_service(service, TIMEOUT)
    except rospy.ROSException as error:
        sys.exit(f"Ended after {TIMEOUT:g} s: {error}")
