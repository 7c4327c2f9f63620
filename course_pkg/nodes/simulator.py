"""The node `simulator`: shows the robot as in a looking glass, while it is busy with its own pictures.

What it hears on `joint_states` it shows at once on `mirrored_joints`. Beside that, at a pace of its own, it
draws, and `~pictures` says how many pictures are done.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import UInt32

from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import number_parameter, step_onto_graph

DRAWING = 0.4  # s that it spends on a picture
QUIET = 5.0  # s between two warnings


class Simulator:
    """What it shows, and how many pictures it has drawn."""

    def __init__(self) -> None:
        self._shown = rospy.Publisher("mirrored_joints", JointState, queue_size=10, tcp_nodelay=True)
        self._pictures = rospy.Publisher("~pictures", UInt32, queue_size=1)
        self._over = threading.Event()
        rospy.on_shutdown(self._over.set)
        self._robot = rospy.Subscriber("joint_states", JointState, self.show, tcp_nodelay=True)

    def show(self, message: JointState) -> None:
        """Show one message; rospy calls this on a thread of its own. One that is no stance is left out."""
        try:
            self._shown.publish(mirrored(message))
        except ValueError as error:
            rospy.logwarn_throttle(QUIET, "Not shown: %s", error)

    def draw(self, seconds: float) -> None:
        """Draw one picture after the other, `seconds` each, until the node is shut down."""
        done = 0
        while not self._over.wait(seconds):
            done += 1
            self._pictures.publish(done)


def main() -> None:
    """Mirror what the robot says, and draw, `~drawing` (default 0.4) s a picture."""
    if not step_onto_graph("simulator"):
        return
    seconds = number_parameter("~drawing", DRAWING, 0.01, 60.0)
    with undisturbed():
        simulator = Simulator()
    simulator.draw(seconds)


def mirrored(message: JointState) -> JointState:
    """Return the stance that a looking glass shows: every angle and every velocity with its sign turned.

    The header stays, and with it the time at which the robot stood so. Raises ValueError for a message that
    is no stance: numbers that are not finite, or not as many as there are joints.
    """
    count = len(message.name)
    return JointState(  # type: ignore[no-untyped-call]
        header=message.header,
        name=message.name,
        position=_turned("positions", message.position, count),
        velocity=_turned("velocities", message.velocity, count) if message.velocity else [],
        effort=message.effort,
    )


def _turned(what: str, values: Sequence[float], count: int) -> list[float]:
    if len(values) != count:
        raise ValueError(f"{len(values)} {what} for {count} joints")
    if not all(map(math.isfinite, values)):
        raise ValueError(f"one of the {what} is no finite number")
    return [-value for value in values]
