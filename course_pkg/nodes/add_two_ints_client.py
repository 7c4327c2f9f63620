"""The node `add_two_ints_client`: has two whole numbers added by `add_two_ints`, and prints the sum."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.graph.program import ask_once, complain, print_answer
from course_pkg.nodes.add_two_ints_server import LARGEST
from course_pkg.srv import AddTwoInts

USAGE = "usage: add_two_ints_client A B   (two whole numbers that an int64 holds, such as 20 22)"


def main() -> None:
    """Add the numbers of the command line; exit with 1 when nobody does, with 2 for a wrong line."""
    numbers = read_numbers(rospy.myargv(sys.argv)[1:])
    if numbers is None:
        sys.exit(complain(USAGE, 2))
    a, b = numbers
    sys.exit(print_answer(lambda: f"{a} + {b} = {_sum(a, b)}"))


def read_numbers(words: Sequence[str]) -> tuple[int, int] | None:
    """Return a and b, or None when the words are not two numbers that an int64 holds."""
    try:
        a, b = map(int, words)
    except ValueError:
        return None
    return (a, b) if all(-LARGEST - 1 <= number <= LARGEST for number in (a, b)) else None


def _sum(a: int, b: int) -> int:
    return int(ask_once("add_two_ints_client", "add_two_ints", AddTwoInts, a, b).sum)
