"""The node `pubvel_toggle_plus`: `pubvel_toggle`, and a call of `change_rate` says how often it speaks."""

from __future__ import annotations

from course_pkg.turtlesim.remote import run


def main() -> None:
    """Drive until the node is shut down."""
    run("pubvel_toggle_plus", "toggle_forward", "change_rate")
