"""The node `draw_square`: drives turtle1 along a square, and corrects the velocity after each pose."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim.msg import Pose

from course_pkg.ros import prepare_node
from course_pkg.turtlesim.world import normalized

SIDE = 2.0  # A side of the square has this length in m.
CORNER = math.pi / 2  # The turtle turns by this angle in rad at each corner.
SPEED = 1.0  # This is the maximum velocity in m/s.
TURN = 0.8  # This is the maximum angular velocity in rad/s.
TOLERANCE = 0.01  # A side or corner may end with this error in m or rad.
# The velocity is at most `SLOW` (in 1/s) times the remaining distance or angle. The turtle therefore slows
# down before the end of a side or corner.
SLOW = 4.0


@dataclass(frozen=True)
class Walker:
    """The pose at the beginning of the square's current side or corner; `turning` is true at a corner."""

    x: float
    y: float
    theta: float
    turning: bool = False

    def steer(self, x: float, y: float, theta: float) -> tuple[float, float]:
        """Return the velocity (m/s) and the angular velocity (rad/s) for a pose of the turtle.

        At the end of the side or corner, the velocity and the angular velocity are 0.
        """
        if self.turning:
            rest = normalized(self.theta + CORNER - theta)
            return 0.0, _limited(rest, TURN)
        return _limited(SIDE - math.hypot(x - self.x, y - self.y), SPEED), 0.0

    def after(self, x: float, y: float) -> Walker:
        """Return the Walker for the next side or corner, which begins at (x, y)."""
        if self.turning:
            # The next side starts from the planned angle. With the turtle's real angle, small errors would
            # add up.
            return Walker(x, y, self.theta + CORNER)
        return replace(self, turning=True)


def main() -> None:
    """Drive turtle1 until the node is shut down."""
    rospy.init_node("draw_square")
    prepare_node()
    walking = _Walking(rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1))
    rospy.wait_for_service("reset")
    rospy.ServiceProxy("reset", Empty)()
    rospy.Subscriber("turtle1/pose", Pose, walking.move, queue_size=1)
    rospy.spin()


class _Walking:
    def __init__(self, publisher: rospy.Publisher) -> None:
        self._publisher = publisher
        self._walker: Walker | None = None

    def move(self, pose: Pose) -> None:
        """Publish the velocity for a received pose."""
        here = (pose.x, pose.y, pose.theta)
        walker = self._walker or Walker(*here)
        speed, turn = walker.steer(*here)
        if not (speed or turn):
            walker = walker.after(pose.x, pose.y)
            rospy.loginfo("Turning the corner" if walker.turning else "Along the next side")
        self._walker = walker
        command = Twist()
        command.linear.x, command.angular.z = speed, turn
        self._publisher.publish(command)


def _limited(rest: float, limit: float) -> float:
    return 0.0 if abs(rest) < TOLERANCE else max(-limit, min(limit, SLOW * rest))
