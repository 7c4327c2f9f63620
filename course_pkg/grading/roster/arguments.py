"""The options of `course grade` for an instructor's lists."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser


def add_roster_arguments(parser: ArgumentParser) -> None:
    """Add --roster and --moodle-worksheet to the command line."""
    parser.add_argument(
        "--roster",
        type=Path,
        metavar="FILE",
        help="a CSV file with the students of the class (columns name, id, email, username, section): the "
        "reports then show who is missing, and contain these columns; with the column extension_days, the "
        "deadlines of these students are later by that number of days",
    )
    parser.add_argument(
        "--moodle-worksheet",
        type=Path,
        metavar="FILE",
        help="the grading worksheet of the assignment in Moodle: moodle_worksheet.csv is then a copy of it "
        "with grades and feedback, which Moodle imports",
    )
