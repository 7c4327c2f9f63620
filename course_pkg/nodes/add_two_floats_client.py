"""The node `add_two_floats_client`: asks `add_two_ints` by another definition of the type, and is refused.

Its definition has the name AddTwoInts and float64 in place of int64, as after an edit that was built on one
side only. The server compares the MD5 sums when it connects.
"""

from __future__ import annotations

import sys

from course_pkg.interfaces import compile_service
from course_pkg.nodes.add_two_ints_client import add

NAME = "course_pkg/AddTwoInts"
DEFINITION = "float64 a\nfloat64 b\n---\nfloat64 sum"
USAGE = "usage: add_two_floats_client A B   (two numbers, such as 1.5 2)"


def main() -> None:
    """Ask with the numbers of the command line; exit with 1 when refused, with 2 for a wrong line."""
    sys.exit(add("add_two_floats_client", compile_service(NAME, DEFINITION), float, USAGE))
