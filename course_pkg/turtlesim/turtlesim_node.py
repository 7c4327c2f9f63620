"""The node `turtlesim`: a world of turtles to be driven by topics and services."""

from __future__ import annotations

import rospy

from course_pkg.graph.handshake import guard_against_idle_connections
from course_pkg.graph.registrar import hasten_shutdown
from course_pkg.turtlesim.answering import word_refusals
from course_pkg.turtlesim.simulator import Simulator


def main() -> None:
    """Simulate until the node is shut down."""
    rospy.init_node("turtlesim")
    guard_against_idle_connections()
    hasten_shutdown()
    word_refusals()
    rospy.loginfo(f"Starting turtlesim with node name {rospy.get_name()}")
    Simulator().run()
