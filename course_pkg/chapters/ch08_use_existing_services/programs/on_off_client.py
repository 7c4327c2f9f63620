"""The node `on_off_client` calls the service `on_off` with 0 or 1 at random, and prints the response."""

from __future__ import annotations

import random
import sys

import rospy

from course_pkg.ros.node.program import call_once, complain, print_response
from course_pkg.srv import ServiceExample

USAGE = "usage: on_off_client   (no arguments; the program sends 0 or 1 at random)"


def main() -> None:
    """Make one call; the exit status is 1 if the call fails, and 2 if the arguments are wrong."""
    if len(rospy.myargv(sys.argv)) > 1:
        sys.exit(complain(USAGE, 2))
    number = random.randint(0, 1)  # noqa: S311 -- the number is not a secret
    sys.exit(print_response(lambda: f"{number}: {_state(number)}"))


def _state(number: int) -> str:
    return str(call_once("on_off_client", "on_off", ServiceExample, number).state)
