"""The node `customer_detector`: waits for a customer at the counter, and returns whether one is there.

It subscribes to `customer_seen` (std_msgs/Bool), and serves `detect_customer` (course_pkg/AwaitCustomer). A
call waits for a customer, but never longer than the request allows.
"""

from __future__ import annotations

import rospy
from std_msgs.msg import Bool

from course_pkg.errors import CameraSilent
from course_pkg.ros.node.program import start_node, undisturbed
from course_pkg.shop.watch import Eye, await_customer
from course_pkg.srv import AwaitCustomer, AwaitCustomerRequest

LONGEST = 60.0  # s that a client may wait


class CustomerDetector:
    """Returns whether a customer is there."""

    def __init__(self) -> None:
        self._eye = Eye[Bool](lambda message: bool(message.data))
        rospy.Subscriber("customer_seen", Bool, self._eye.hear, queue_size=1, tcp_nodelay=True)

    def handle_detect(self, request: AwaitCustomerRequest) -> bool:
        """Return True as soon as a customer is there, and False after `patience` s.

        Raise ServiceException if `patience` is impossible, or if the camera is silent.
        """
        if not 0.0 <= request.patience <= LONGEST:  # this comparison is false for nan
            message = f"patience is {request.patience:g} s, but it has to be from 0 to {LONGEST:g} s"
            raise rospy.ServiceException(message)
        try:
            return await_customer(self._eye, request.patience)
        except CameraSilent as error:
            raise rospy.ServiceException(str(error)) from error


def main() -> None:
    """Detect until the node is shut down."""
    if not start_node("customer_detector"):
        return
    with undisturbed():
        detector = CustomerDetector()
        rospy.Service("detect_customer", AwaitCustomer, detector.handle_detect)
    rospy.spin()
