"""The node `turtlesim`: a world of turtles to be driven by topics and services."""

from __future__ import annotations

import rospy

from course_pkg.graph import prepare_node
from course_pkg.turtlesim.answering import word_refusals
from course_pkg.turtlesim.simulator import Simulator


def main() -> None:
    """Simulate until the node is shut down."""
    rospy.init_node("turtlesim")
    prepare_node()
    word_refusals()
    rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
    Simulator().run()
