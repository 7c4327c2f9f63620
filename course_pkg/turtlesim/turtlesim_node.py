"""The node `turtlesim`: a world of turtles with topics and services."""

from __future__ import annotations

import rospy

from course_pkg.ros import prepare_node
from course_pkg.turtlesim.roscpp_services import refuse_like_roscpp
from course_pkg.turtlesim.simulator import Simulator


def main() -> None:
    """Run the simulation until the node is shut down."""
    rospy.init_node("turtlesim")
    prepare_node()
    refuse_like_roscpp()
    rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
    Simulator().run()
