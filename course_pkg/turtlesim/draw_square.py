"""The node `draw_square`: has turtle1 walk a square, steered by what its pose says."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim.msg import Pose

from course_pkg.graph import prepare_node
from course_pkg.turtlesim.world import wrapped

SIDE = 2.0  # m
CORNER = math.pi / 2
SPEED = 1.0  # m/s at most
TURN = 0.8  # rad/s at most
NEAR = 0.01  # m or rad that is near enough
SLOW = 4.0  # 1/s: how much of what remains is done in a second, so that it ends gently


@dataclass(frozen=True)
class Walker:
    """Where it began its side or its corner, and which of the two it is at."""

    x: float
    y: float
    theta: float
    turning: bool = False

    def steer(self, x: float, y: float, theta: float) -> tuple[float, float]:
        """Return the velocity (m/s) and the turn (rad/s) for where the turtle is; both 0 at the end."""
        if self.turning:
            rest = wrapped(self.theta + CORNER - theta)
            return 0.0, _gentle(rest, TURN)
        return _gentle(SIDE - math.hypot(x - self.x, y - self.y), SPEED), 0.0

    def after(self, x: float, y: float) -> Walker:
        """Return the walker that goes on from here."""
        if self.turning:
            return Walker(x, y, self.theta + CORNER)  # the corner it meant: small errors do not add up
        return replace(self, turning=True)


def main() -> None:
    """Walk until the node is shut down."""
    rospy.init_node("draw_square")
    prepare_node()
    walking = _Walking(rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1))
    rospy.wait_for_service("reset")
    rospy.ServiceProxy("reset", Empty)()
    rospy.Subscriber("turtle1/pose", Pose, walking.see, queue_size=1)
    rospy.spin()


class _Walking:
    def __init__(self, publisher: rospy.Publisher) -> None:
        self._publisher = publisher
        self._walker: Walker | None = None

    def see(self, pose: Any) -> None:  # noqa: ANN401 -- a class that catkin generates
        """Say how to go on from a pose."""
        here = (pose.x, pose.y, pose.theta)
        walker = self._walker or Walker(*here)
        speed, turn = walker.steer(*here)
        if not (speed or turn):
            walker = walker.after(pose.x, pose.y)
            rospy.loginfo("Turning the corner" if walker.turning else "Along the next side")
        self._walker = walker
        order = Twist()
        order.linear.x, order.angular.z = speed, turn
        self._publisher.publish(order)


def _gentle(rest: float, fastest: float) -> float:
    return 0.0 if abs(rest) < NEAR else max(-fastest, min(fastest, SLOW * rest))
