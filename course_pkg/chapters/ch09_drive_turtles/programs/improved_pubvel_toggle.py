"""The node `improved_pubvel_toggle`: `pubvel_toggle_plus` with two more services.

One service sets the speed, and the other service stops the turtle.
"""

from __future__ import annotations

from course_pkg.turtlesim.driver_node import run


def main() -> None:
    """Drive until the node is shut down."""
    run("improved_pubvel_toggle", "toggle_forward", "change_rate", "change_speed", "start_stop")
