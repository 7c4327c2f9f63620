"""The node `robot_cashier`: mirrors the arm, and greets customers at the same time.

The node publishes the mirror image of each message on the topic `joint_states` on the topic
`mirrored_joints`. The node calls the service `detect_customer` (course_pkg/AwaitCustomer) repeatedly;
`patience` in the request is the value of the parameter `~wait` (default 2 s). For each visit, the node
publishes one greeting on the topic `greetings` (std_msgs/String). After a visit, the node calls `till/reset`
(std_srvs/Trigger).
"""

from __future__ import annotations

import threading
from contextlib import suppress

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger

from course_pkg.errors import CourseError
from course_pkg.nodes.simulator import mirrored
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.srv import AwaitCustomer

QUIET = 5.0  # The node writes at most one warning every `QUIET` s.
GRACE = 2.0  # GRACE is the additional time in s that a call may take after its `patience`.
AGAIN = 0.5  # AGAIN is the time in s between a failed call and the next call.
POLL = 0.2  # POLL is the time in s between two calls while a customer is there.
FAILED = (rospy.ServiceException, CourseError)


class RobotCashier:
    """Mirrors the arm, waits for customers, and greets them."""

    def __init__(self) -> None:
        self._mirror = rospy.Publisher("mirrored_joints", JointState, queue_size=10, tcp_nodelay=True)
        self._greetings = rospy.Publisher("greetings", String, queue_size=10)
        self._detect = BoundedProxy("detect_customer", AwaitCustomer)
        self._reset = BoundedProxy("till/reset", Trigger)
        self._over = threading.Event()
        for proxy in (self._detect, self._reset):
            # A shutdown cancels the current call; otherwise, the shutdown would wait for the end of the call.
            rospy.on_shutdown(proxy.cancel)
        rospy.on_shutdown(self._over.set)
        rospy.Subscriber("joint_states", JointState, self.mirror, tcp_nodelay=True)

    def mirror(self, joints: JointState) -> None:
        """Publish the mirror image of a joint state; rospy calls this method on a separate thread."""
        try:
            self._mirror.publish(mirrored(joints))
        except ValueError as error:
            rospy.logwarn_throttle(QUIET, "No mirror image, because the joint state is invalid: %s", error)

    def greet(self, wait: float) -> None:
        """Wait for customers and greet them until the node is shut down."""
        while not self._over.is_set():
            if self._is_there(wait):
                self._greetings.publish("Good day!")
                self._await_departure()
                self._empty_till()

    def _is_there(self, wait: float, otherwise: bool = False) -> bool:
        """Return whether a customer comes within the time `wait` (s); after an error, return `otherwise`."""
        try:
            return bool(self._detect.call(patience=wait, timeout=wait + GRACE).found)
        except FAILED as error:
            if not self._over.is_set():  # After a shutdown, the error is expected and is not logged.
                with undisturbed():  # For each log message, rospy calls the master.
                    rospy.logwarn_throttle(
                        QUIET,
                        "The call of detect_customer failed, and the node will repeat the call: %s",
                        error,
                    )
            self._over.wait(AGAIN)
            return otherwise

    def _await_departure(self) -> None:
        """Wait until the customer has left; after a failed call, continue to wait."""
        while not self._over.wait(POLL) and self._is_there(0, otherwise=True):
            pass

    def _empty_till(self) -> None:
        """Reset the till once; if this fails, the cashier continues."""
        try:
            self._reset.call(timeout=GRACE)
        except FAILED as error:
            if not self._over.is_set():
                rospy.logwarn("The call of till/reset failed: %s", error)


def main() -> None:
    """Mirror the arm and greet customers until the node is shut down."""
    if not start_node("robot_cashier"):
        return
    wait = number_parameter("~wait", 2.0, 0.1, 60.0)
    with undisturbed():
        cashier = RobotCashier()
    with suppress(rospy.ROSInterruptException):  # The node was shut down during a call.
        cashier.greet(wait)
