"""The node `pubvel_toggle`: drives turtle1 straight ahead or turns it.

`toggle_forward` changes the direction.
"""

from __future__ import annotations

from course_pkg.turtlesim.driver_node import run


def main() -> None:
    """Drive until the node is shut down."""
    run("pubvel_toggle", "toggle_forward")
