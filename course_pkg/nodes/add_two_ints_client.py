"""The node `add_two_ints_client`: has two whole numbers added by `add_two_ints`, and prints the sum."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import rospy

from course_pkg.graph.program import ask_once, complain, print_answer
from course_pkg.nodes.add_two_ints_server import LARGEST
from course_pkg.srv import AddTwoInts

USAGE = "usage: add_two_ints_client A B   (two whole numbers that an int64 holds, such as 20 22)"


def main() -> None:
    """Add the numbers of the command line; exit with 1 when nobody does, with 2 for a wrong line."""
    sys.exit(add("add_two_ints_client", AddTwoInts, int64, USAGE))


def add(node: str, kind: Any, read: Callable[[str], float], usage: str) -> int:  # noqa: ANN401 -- a generated class
    """Have the two numbers of the command line added by the node `node`, and return the exit status.

    `kind` is what the client takes for the type of the service, and `read` makes a number of a word or
    raises ValueError.
    """
    try:
        a, b = map(read, rospy.myargv(sys.argv)[1:])
    except ValueError:
        return complain(usage, 2)
    return print_answer(lambda: f"{a} + {b} = {ask_once(node, 'add_two_ints', kind, a, b).sum}")


def int64(word: str) -> int:
    """Return the whole number that a word stands for; raises ValueError where an int64 cannot hold it."""
    number = int(word)
    if not -LARGEST - 1 <= number <= LARGEST:
        raise ValueError(word)
    return number
