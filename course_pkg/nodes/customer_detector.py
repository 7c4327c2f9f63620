"""The node `customer_detector`: says whether a customer is at the counter of the robot cashier.

It listens to `frames` (sensor_msgs/Image), and serves `detect_customer` (course_pkg/AwaitCustomer), which
waits for somebody, but never longer than it is told to.
"""

from __future__ import annotations

from typing import Any

import rospy
from sensor_msgs.msg import Image

from course_pkg.errors import CameraSilent
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import step_onto_graph
from course_pkg.shop.eye import Eye, await_customer
from course_pkg.shop.frames import sees_customer
from course_pkg.srv import AwaitCustomer

LONGEST = 60.0  # s that a caller may wait


class CustomerDetector:
    """Answers whether somebody is there."""

    def __init__(self) -> None:
        self._eye = Eye(sees_customer)
        # Only the newest frame counts, so no older one has to wait for its turn.
        rospy.Subscriber("frames", Image, self._eye.hear, queue_size=1, tcp_nodelay=True)

    def handle_detect(self, request: Any) -> bool:  # noqa: ANN401 -- a class that catkin generates
        """Answer as soon as somebody is there, and after `patience` s in any case."""
        if not 0.0 <= request.patience <= LONGEST:  # which a NaN is not
            words = f"patience is {request.patience:g} s, and has to be from 0 to {LONGEST:g} s"
            raise rospy.ServiceException(words)
        try:
            return await_customer(self._eye, request.patience)
        except CameraSilent as error:
            raise rospy.ServiceException(f"{error}: does counter_camera run?") from error


def main() -> None:
    """Detect until the node is shut down."""
    if not step_onto_graph("customer_detector"):
        return
    with undisturbed():
        detector = CustomerDetector()
        rospy.Service("detect_customer", AwaitCustomer, detector.handle_detect)
    rospy.loginfo("Looking out for customers")
    rospy.spin()
