"""The node `pubvel_toggle_plus`: `pubvel_toggle` with one more service.

The service `change_rate` sets the publishing rate.
"""

from __future__ import annotations

from course_pkg.turtlesim.driver_node import run


def main() -> None:
    """Drive until the node is shut down."""
    run("pubvel_toggle_plus", "toggle_forward", "change_rate")
