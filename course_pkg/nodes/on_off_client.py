"""The node `on_off_client`: sends 0 or 1 to `on_off`, as chance has it, and prints what comes back."""

from __future__ import annotations

import random
import sys

import rospy

from course_pkg.graph.program import ask_once, complain, print_answer
from course_pkg.srv import ServiceExample

USAGE = "usage: on_off_client   (no arguments: it sends 0 or 1, as chance has it)"


def main() -> None:
    """Ask once; exit with 1 when nobody answers, with 2 for a wrong line."""
    if len(rospy.myargv(sys.argv)) > 1:
        sys.exit(complain(USAGE, 2))
    number = random.randint(0, 1)  # noqa: S311 -- a coin, not a secret
    sys.exit(print_answer(lambda: f"{number}: {_state(number)}"))


def _state(number: int) -> str:
    return str(ask_once("on_off_client", "on_off", ServiceExample, number).state)
