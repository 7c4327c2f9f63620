"""The node `spawn_turtle`: waits at most 5 s for a simulator, makes MyTurtle at (3, 3), and ends."""

from __future__ import annotations

import rospy

from course_pkg.graph import prepare_node
from course_pkg.turtlesim.spawning import spawn_or_exit


def main() -> None:
    """Spawn, and say how it went; exit status 1 where it did not."""
    rospy.init_node("spawn_turtle")
    prepare_node()
    spawn_or_exit()
