"""The node `add_two_floats_client`: asks `add_two_ints` by another definition of the type, and is refused.

Its definition has the name AddTwoInts and float64 in place of int64, as after an edit that was built on one
side only. The server compares the MD5 sums when it connects.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.graph.program import ask_once, complain, print_answer
from course_pkg.interfaces import compile_service

NAME = "course_pkg/AddTwoInts"
DEFINITION = "float64 a\nfloat64 b\n---\nfloat64 sum"
USAGE = "usage: add_two_floats_client A B   (two numbers, such as 1.5 2)"


def main() -> None:
    """Ask with the numbers of the command line; exit with 1 when refused, with 2 for a wrong line."""
    numbers = read_numbers(rospy.myargv(sys.argv)[1:])
    if numbers is None:
        sys.exit(complain(USAGE, 2))
    a, b = numbers
    sys.exit(print_answer(lambda: f"{a:g} + {b:g} = {_sum(a, b):g}"))


def read_numbers(words: Sequence[str]) -> tuple[float, float] | None:
    """Return a and b, or None when the words are not two numbers."""
    try:
        a, b = map(float, words)
    except ValueError:
        return None
    return a, b


def _sum(a: float, b: float) -> float:
    kind = compile_service(NAME, DEFINITION)
    return float(ask_once("add_two_floats_client", "add_two_ints", kind, a, b).sum)
