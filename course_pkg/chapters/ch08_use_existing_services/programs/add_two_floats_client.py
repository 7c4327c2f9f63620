"""The node `add_two_floats_client`: a client with a wrong type; `add_two_ints` refuses the connection.

The types of the client and the server have the same name, AddTwoInts, but the client's fields are float64
instead of int64. This happens in practice if a definition was changed, and only the client was built again.
When a client connects, the server compares the MD5 sums of both types.
"""

from __future__ import annotations

import sys

from course_pkg.chapters.ch08_use_existing_services.programs.add_two_ints_client import add
from course_pkg.types import compile_service

NAME = "course_pkg/AddTwoInts"
DEFINITION = "float64 a\nfloat64 b\n---\nfloat64 sum"
USAGE = "usage: add_two_floats_client A B   (two numbers, such as 1.5 2)"


def main() -> None:
    """Call the service `add_two_ints` with the numbers on the command line.

    The exit status is 1 after a refusal, and 2 for wrong arguments.
    """
    sys.exit(add("add_two_floats_client", compile_service(NAME, DEFINITION), float, USAGE))
