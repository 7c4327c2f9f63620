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
        help=(
            "the deadline, such as 2026-11-01T23:59+01:00, or 05=TIME for chapter 05 only. You can repeat "
            "this option. The column extension_days in the file of --roster moves the deadline for "
            "individual students"
        ),
    )
    group.add_argument(
        "--times",
        default="",
        metavar="TABLE",
        help=(
            "the file with the time of each submission: Moodle's grading worksheet, or a CSV file with "
            "student,submitted or student,chapter,submitted. Give the word `nbgrader` to read "
            "timestamp.txt. The command reads times.csv in SUBMISSIONS and Gradescope's metadata even "
            "without this option"
        ),
    )
    group.add_argument(
        "--time-zone",
        default="",
        metavar="ZONE",
        help=(
            "the time zone of each time without an offset, such as Europe/Berlin. Without this option, "
            "such a time is an error"
        ),
    )
    group.add_argument(
        "--grace-minutes",
        type=float,
        default=0.0,
        metavar="N",
        help=(
            "the number of minutes after the deadline in which work is not late (default: 0). Late days "
            "begin after these minutes"
        ),
    )
    group.add_argument(
        "--late",
        type=Path,
        metavar="TABLE",
        help=("a CSV file with the late days, with the columns student,days or student,chapter,days"),
    )
    group.add_argument(
        "--late-per-day",
        type=float,
        metavar="PERCENT",
        help=(
            "the percentage of the points that is deducted for each late day, such as 10. A day that has "
            "begun counts as a whole day"
        ),
    )
    group.add_argument(
        "--late-max-days",
        type=float,
        metavar="N",
        help="the number of late days after which no points are left, such as 3",
    )
    group.add_argument(
        "--attempts",
        choices=("last", "best"),
        default="last",
        help=(
            "the attempt that counts if a student has handed in a chapter several times: the last "
            "attempt (default), or the attempt with the most points after the deduction for lateness"
        ),
    )
