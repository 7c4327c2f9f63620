"""The node `simulator` publishes the mirror image of the robot, and draws pictures at the same time.

For each message on the topic `joint_states`, the node immediately publishes the mirror image on the topic
`mirrored_joints`. The node also publishes the number of finished pictures on `~pictures`.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import UInt32

from course_pkg.ros.node.program import number_parameter, start_node, undisturbed

DRAWING = 0.4  # The drawing of one picture takes this time in s.
QUIET = 5.0  # QUIET is the minimum time in s between two warnings.


class Simulator:
    """Publishes mirrored joint states and the number of pictures."""

    def __init__(self) -> None:
        self._shown = rospy.Publisher("mirrored_joints", JointState, queue_size=10, tcp_nodelay=True)
        self._pictures = rospy.Publisher("~pictures", UInt32, queue_size=1)
        self._over = threading.Event()
        rospy.on_shutdown(self._over.set)
        self._robot = rospy.Subscriber("joint_states", JointState, self.show, tcp_nodelay=True)

    def show(self, message: JointState) -> None:
        """Publish the mirror image of a valid joint state.

        rospy calls this method on one of its own threads.
        """
        try:
            self._shown.publish(mirrored(message))
        except ValueError as error:
            rospy.logwarn_throttle(QUIET, "Ignored an invalid joint state: %s", error)

    def draw(self, seconds: float) -> None:
        """Draw one picture after another until the node is shut down.

        `seconds` is the time in s for each picture.
        """
        done = 0
        while not self._over.wait(seconds):
            done += 1
            self._pictures.publish(done)


def main() -> None:
    """Mirror the robot, and draw pictures, until the node is shut down.

    The parameter ~drawing (default 0.4) is the time in s for each picture.
    """
    if not start_node("simulator"):
        return
    seconds = number_parameter("~drawing", DRAWING, 0.01, 60.0)
    with undisturbed():
        simulator = Simulator()
    simulator.draw(seconds)


def mirrored(message: JointState) -> JointState:
    """Return the mirror image of a joint state: each position and each velocity with the opposite sign.

    The header, which contains the time, does not change. Raises ValueError if a position or a velocity is not
    finite, or if the number of positions or velocities differs from the number of joints.
    """
    count = len(message.name)
    return JointState(
        header=message.header,
        name=message.name,
        position=_negated("positions", message.position, count),
        velocity=_negated("velocities", message.velocity, count) if message.velocity else [],
        effort=message.effort,
    )


def _negated(what: str, values: Sequence[float], count: int) -> list[float]:
    if len(values) != count:
        raise ValueError(f"{len(values)} {what} for {count} joints")
    if not all(map(math.isfinite, values)):
        raise ValueError(f"one of the {what} is not a finite number")
    return [-value for value in values]
