"""Bringing MyTurtle into the world, for the two programs that do."""

from __future__ import annotations

import sys

import rospy
from turtlesim.srv import Spawn

NAME = "MyTurtle"
PLACE = (3.0, 3.0, 0.0)
PATIENCE = 5.0  # s


def spawn_or_exit() -> None:
    """Make MyTurtle at (3, 3), once there is a simulator; end the program with 1 where that cannot be."""
    require("spawn")
    try:
        response = rospy.ServiceProxy("spawn", Spawn)(*PLACE, NAME)
    except rospy.ServiceException as error:
        sys.exit(f"{NAME} was not made: {error}. Is there one already? The simulator's log says why.")
    rospy.loginfo("Spawned a turtle named %s", response.name)


def require(service: str) -> None:
    """Wait for a service; end the program with 1 where it does not come in time."""
    try:
        rospy.wait_for_service(service, PATIENCE)
    except rospy.ROSException as error:
        sys.exit(f"Gave up after {PATIENCE:g} s: {error}")
