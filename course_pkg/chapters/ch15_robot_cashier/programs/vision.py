"""The node `vision`: publishes on the topic `customer_seen` (std_msgs/Bool) whether a frame shows a customer.

The node subscribes to the topic `frames` (sensor_msgs/Image), and publishes one message for each valid frame.
"""

from __future__ import annotations

import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import Bool

from course_pkg.ros.node.program import start_node, undisturbed
from course_pkg.shop.pictures import sees_customer

QUIET = 5.0  # The node writes at most one warning every `QUIET` s.


class Vision:
    """Looks for customers in each frame."""

    def __init__(self) -> None:
        self._seen = rospy.Publisher("customer_seen", Bool, queue_size=1, tcp_nodelay=True)
        # Only the newest frame is used, so a longer queue is not needed.
        rospy.Subscriber("frames", Image, self.handle_frame, queue_size=1, tcp_nodelay=True)

    def handle_frame(self, frame: Image) -> None:
        """Publish whether a frame shows a customer; if the frame is malformed, publish nothing."""
        try:
            self._seen.publish(sees_customer(frame))
        except ValueError as error:
            rospy.logwarn_throttle(QUIET, "Ignored a frame: %s", error)


def main() -> None:
    """Handle frames until the node is shut down."""
    if not start_node("vision"):
        return
    with undisturbed():
        Vision()
    rospy.spin()
