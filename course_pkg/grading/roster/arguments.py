"""The options of `course grade` for a roster and for Moodle's worksheet."""

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
        help=(
            "a CSV file with the students of the class (columns name, id, email, username, section). The "
            "reports then show missing students, and contain these columns. The column extension_days "
            "contains the number of days by which a student's deadlines are later"
        ),
    )
    parser.add_argument(
        "--moodle-worksheet",
        type=Path,
        metavar="FILE",
        help=(
            "the grading worksheet of the assignment in Moodle. The course writes moodle_worksheet.csv, "
            "a copy with grades and feedback that you import in Moodle"
        ),
    )
