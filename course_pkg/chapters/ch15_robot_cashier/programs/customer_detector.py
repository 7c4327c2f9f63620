"""The node `customer_detector`: waits for a customer at the counter, and returns whether there is one.

The node subscribes to the topic `customer_seen` (std_msgs/Bool), and offers the service `detect_customer`
(course_pkg/AwaitCustomer). A call waits for a customer; the request contains the maximum waiting time.
"""

from __future__ import annotations

import rospy
from std_msgs.msg import Bool

from course_pkg.errors import CameraSilent
from course_pkg.ros.node.program import start_node, undisturbed
from course_pkg.shop.watch import Eye, await_customer
from course_pkg.srv import AwaitCustomer, AwaitCustomerRequest

LONGEST = 60.0  # A client can wait up to this time in s.


class CustomerDetector:
    """Waits for a customer, and returns whether a customer is there."""

    def __init__(self) -> None:
        self._eye = Eye[Bool](lambda message: bool(message.data))
        rospy.Subscriber("customer_seen", Bool, self._eye.hear, queue_size=1, tcp_nodelay=True)

    def handle_detect(self, request: AwaitCustomerRequest) -> bool:
        """Return True as soon as there is a customer; return False if none comes within `patience` (s).

        Raises ServiceException if `patience` is out of range, or if the camera sends no messages.
        """
        # This test refuses NaN, because each comparison with NaN is False.
        if not 0.0 <= request.patience <= LONGEST:
            message = f"patience is {request.patience:g} s, but it has to be from 0 to {LONGEST:g} s"
            raise rospy.ServiceException(message)
        try:
            return await_customer(self._eye, request.patience)
        except CameraSilent as error:
            raise rospy.ServiceException(str(error)) from error


def main() -> None:
    """Handle calls until the node is shut down."""
    if not start_node("customer_detector"):
        return
    with undisturbed():
        detector = CustomerDetector()
        rospy.Service("detect_customer", AwaitCustomer, detector.handle_detect)
    rospy.spin()
