"""The node `pubvel_toggle_plus`: `pubvel_toggle` with a service `change_rate` for its publishing rate."""

from __future__ import annotations

from course_pkg.turtlesim.driver_node import run


def main() -> None:
    """Drive until the node is shut down."""
    run("pubvel_toggle_plus", "toggle_forward", "change_rate")
