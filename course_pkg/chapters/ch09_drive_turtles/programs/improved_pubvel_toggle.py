"""The node `improved_pubvel_toggle`: `pubvel_toggle_plus` with two more services.

The service `change_speed` sets the speed, and the service `start_stop` stops and starts the turtle.
"""

from __future__ import annotations

from course_pkg.turtlesim.driver_node import run


def main() -> None:
    """Drive until the node is shut down."""
    run("improved_pubvel_toggle", "toggle_forward", "change_rate", "change_speed", "start_stop")
