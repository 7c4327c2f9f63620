"""The node `robot_cashier`: mirrors the arm at once, and greets whoever comes, both at the same time.

What it hears on `joint_states` it says on `mirrored_joints`, with its signs turned. It asks `detect_customer`
(course_pkg/AwaitCustomer) again and again, each time with a patience of `~wait` (default 2) s, and says on
`greetings` (std_msgs/String) that somebody has come, once for each who does.
"""

from __future__ import annotations

import threading
from contextlib import suppress

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from course_pkg.errors import CourseError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import number_parameter, step_onto_graph
from course_pkg.nodes.simulator import mirrored
from course_pkg.srv import AwaitCustomer

QUIET = 5.0  # s between two warnings
GRACE = 2.0  # s for an answer, beyond what the question itself may take
AGAIN = 0.5  # s until a question that failed is put again
GLANCE = 0.2  # s between looks at whether the customer is still there


class RobotCashier:
    """One arm, and one question that stands most of the time."""

    def __init__(self) -> None:
        self._mirror = rospy.Publisher("mirrored_joints", JointState, queue_size=10, tcp_nodelay=True)
        self._greetings = rospy.Publisher("greetings", String, queue_size=10)
        self._detect = BoundedProxy("detect_customer", AwaitCustomer)
        self._over = threading.Event()
        rospy.on_shutdown(self._detect.cancel)  # or the end waits for the answer to a question that stands
        rospy.on_shutdown(self._over.set)
        rospy.Subscriber("joint_states", JointState, self.mirror, tcp_nodelay=True)

    def mirror(self, stance: JointState) -> None:
        """Say how the arm stands in the looking glass; rospy calls this on a thread of its own."""
        try:
            self._mirror.publish(mirrored(stance))
        except ValueError as error:
            rospy.logwarn_throttle(QUIET, "Not mirrored: %s", error)

    def greet(self, wait: float) -> None:
        """Ask and greet until the node is shut down."""
        while not self._over.is_set():
            try:
                if self._detect.call(patience=wait, timeout=wait + GRACE).found:
                    self._greetings.publish("Good day!")
                    self._see_off()
            except (rospy.ServiceException, CourseError) as error:
                if not self._over.is_set():  # the end of the node has cancelled the question
                    rospy.logwarn_throttle(QUIET, "No answer, and asking on: %s", error)
                self._over.wait(AGAIN)

    def _see_off(self) -> None:
        """Return when the customer has gone; raises what a call raises."""
        while not self._over.wait(GLANCE) and self._detect.call(patience=0, timeout=GRACE).found:
            pass


def main() -> None:
    """Mirror and greet until the node is shut down."""
    if not step_onto_graph("robot_cashier"):
        return
    wait = number_parameter("~wait", 2.0, 0.1, 60.0)
    with undisturbed():
        cashier = RobotCashier()
    with suppress(rospy.ROSInterruptException):  # shut down while a question stood
        cashier.greet(wait)
