"""The node `pulse`: counts aloud on the topic `pulse`, whether or not anybody listens."""

from __future__ import annotations

from itertools import count

import rospy
from std_msgs.msg import UInt32

from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import step_onto_graph


def main() -> None:
    """Publish 0, 1, 2, … until the node is shut down, `~rate` (default 2) of them a second."""
    if not step_onto_graph("pulse"):
        return
    with undisturbed():
        publisher = rospy.Publisher("pulse", UInt32, queue_size=1)
    rate = rospy.Rate(rospy.get_param("~rate", 2.0))
    for number in count():
        if rospy.is_shutdown():
            return
        publisher.publish(number)
        try:
            rate.sleep()
        except rospy.ROSInterruptException:  # shut down while it slept
            return
