"""The node `pubvel_toggle`: drives turtle1 straight or round; a call of `toggle_forward` changes over."""

from __future__ import annotations

from course_pkg.turtlesim.remote import run


def main() -> None:
    """Drive until the node is shut down."""
    run("pubvel_toggle", "toggle_forward")
