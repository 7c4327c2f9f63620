"""The node `add_two_ints_client` calls the service `add_two_ints` with two integers, and prints the sum."""

from __future__ import annotations

import sys
from collections.abc import Callable

import rospy

from course_pkg.chapters.ch08_use_existing_services.programs.add_two_ints_server import LARGEST
from course_pkg.ros.node.program import call_once, complain, print_response
from course_pkg.srv import AddTwoInts
from course_pkg.types import ServiceType

USAGE = "usage: add_two_ints_client A B   (two whole numbers in the range of int64, such as 20 22)"


def main() -> None:
    """Add the numbers on the command line.

    The exit status is 1 if the call fails, and 2 for wrong arguments.
    """
    sys.exit(add("add_two_ints_client", AddTwoInts, int64, USAGE))


def add(node: str, kind: type | ServiceType, read: Callable[[str], float], usage: str) -> int:
    """Call the service `add_two_ints` with the two command-line arguments; return the exit status.

    `node` is the name of the client's node.

    `kind` is the service type that the client uses. `read` converts an argument to a number, and raises
    ValueError for an invalid argument.
    """
    try:
        a, b = map(read, rospy.myargv(sys.argv)[1:])
    except ValueError:
        return complain(usage, 2)
    return print_response(lambda: f"{a} + {b} = {call_once(node, 'add_two_ints', kind, a, b).sum}")


def int64(argument: str) -> int:
    """Return an argument as a whole number; raises ValueError if it is out of the range of an int64."""
    number = int(argument)
    if not -LARGEST - 1 <= number <= LARGEST:
        raise ValueError(argument)
    return number
