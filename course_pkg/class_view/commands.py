"""The command `course class`, and its options."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _class(options: SimpleNamespace) -> int:
    from course_pkg.class_view.command import delete_student, serve_class

    if options.delete is not None:
        return delete_student(options.data, options.delete)
    return serve_class(options)


def _arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--roster", type=Path, metavar="FILE", help="a CSV file with the columns username and name"
    )
    parser.add_argument(
        "--students", type=_positive, metavar="N", help="create N tokens: student01, student02, …"
    )
    parser.add_argument(
        "--teacher", metavar="NAME", help="the teacher's name that students see (default: your user name)"
    )
    parser.add_argument(
        "--port",
        type=int,
        default=8900,
        help="the port on which the service listens (default: 8900); with 0, the service uses any free port",
    )
    parser.add_argument(
        "--ip", default="127.0.0.1", help="the address on which the service listens (default: 127.0.0.1)"
    )
    parser.add_argument(
        "--days",
        type=_days,
        default=30.0,
        help=(
            "delete all results of a student this number of days after the student's last result (default: "
            "30)"
        ),
    )
    parser.add_argument("--data", type=Path, metavar="DIR", help="the folder for results and tokens")
    parser.add_argument(
        "--delete",
        metavar="USER",
        help=("delete the results and the token of a student; do not start the service"),
    )


def _positive(text: str) -> int:
    if not 1 <= (number := int(text)) <= 1000:
        raise ValueError
    return number


def _days(text: str) -> float:
    if not (math.isfinite(number := float(text)) and 0 < number <= 3650):
        raise ValueError
    return number


# For a wrong argument, argparse shows the name of the function that parses it.
_positive.__name__, _days.__name__ = "number from 1 to 1000", "number of days"

COMMANDS = {
    "class": Command(
        "show the results of a class as they happen, on one page for the teacher",
        _class,
        frozenset({"course", "libraries"}),
        _arguments,
    )
}
