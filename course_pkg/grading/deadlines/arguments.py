"""The command-line options about deadlines. This module imports only the standard library."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser


def add_deadline_arguments(parser: ArgumentParser) -> None:
    """Add the options for deadlines, for the deduction of points, and for the attempt that counts."""
    group = parser.add_argument_group("deadlines")
    group.add_argument(
        "--deadline",
        dest="deadlines",
        action="append",
        default=[],
        metavar="[NN=]TIME",
        help="when the work was due, such as 2026-11-01T23:59+01:00; 05=TIME is the deadline of chapter "
        "05 only; can be repeated; the column extension_days of --roster moves the deadline for "
        "single students",
    )
    group.add_argument(
        "--times",
        default="",
        metavar="TABLE",
        help="when each submission was handed in: Moodle's grading worksheet, or a CSV file with "
        "student,submitted or student,chapter,submitted; the word `nbgrader` reads timestamp.txt; "
        "times.csv in SUBMISSIONS and Gradescope's metadata are read without this option",
    )
    group.add_argument(
        "--time-zone",
        default="",
        metavar="ZONE",
        help="the zone of each time without an offset, such as Europe/Berlin (default: none, so that such a "
        "time is an error)",
    )
    group.add_argument(
        "--grace-minutes",
        type=float,
        default=0.0,
        metavar="N",
        help="minutes after the deadline that do not count; late days are counted from their end "
        "(default: 0)",
    )
    group.add_argument(
        "--late", type=Path, metavar="TABLE", help="a CSV file: student,days or student,chapter,days"
    )
    group.add_argument(
        "--late-per-day",
        type=float,
        metavar="PERCENT",
        help="percent of the points to subtract for each late day that has begun, such as 10",
    )
    group.add_argument(
        "--late-max-days",
        type=float,
        metavar="N",
        help="the number of days late after which no points are left, such as 3",
    )
    group.add_argument(
        "--attempts",
        choices=("last", "best"),
        default="last",
        help=(
            "the attempt that counts if a student has handed in a chapter several times: the last attempt "
            "(default), or the attempt with the most points after the deduction for lateness"
        ),
    )
