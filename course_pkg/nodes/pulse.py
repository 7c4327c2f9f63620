"""The node `pulse`: publishes 0, 1, 2, … on the topic `pulse`, even if there are no subscribers."""

from __future__ import annotations

from itertools import count

import rospy
from std_msgs.msg import UInt32

from course_pkg.ros.node.program import number_parameter, start_node, undisturbed


def main() -> None:
    """Publish numbers until the node is shut down; ~rate (default 2) is the number of messages per second."""
    if not start_node("pulse"):
        return
    with undisturbed():
        publisher = rospy.Publisher("pulse", UInt32, queue_size=1)
    rate = rospy.Rate(number_parameter("~rate", 2.0, 0.01, 1000.0))
    for number in count():
        if rospy.is_shutdown():
            return
        publisher.publish(number)
        try:
            rate.sleep()
        except rospy.ROSInterruptException:  # The node was shut down during the sleep.
            return
