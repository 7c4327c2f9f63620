"""The edition of the course in a folder: the instructors' or the students' edition (`course release`)."""

from __future__ import annotations

import json
from pathlib import Path

from course_pkg.errors import SetupError

RECORD = ".course-release.json"  # In the students' edition, this file lists the chapters and files.


def released_chapters(checkout: Path) -> tuple[str, ...] | None:
    """Return the chapters of a students' edition, such as ("05", "06").

    For the instructors' edition, return None.
    """
    try:
        return tuple(map(str, json.loads((checkout / RECORD).read_text("utf-8"))["chapters"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None


def require_solutions(checkout: Path, command: str) -> None:
    """Raise SetupError if `checkout` has no solutions; the command `command` needs them."""
    if (checkout / RECORD).exists():
        raise SetupError(
            f"`course {command}` needs the solutions, but {checkout} is the students' edition, which "
            "contains no solutions. Type the command in the instructors' edition, from which `course "
            "release` created this edition."
        )
    if not any((checkout / "solutions").glob("[0-9][0-9]_*.ipynb")):
        raise SetupError(
            f"`course {command}` needs the solutions, but there are none in "
            f"{checkout / 'solutions'}. Get this folder from the course's repository, and type "
            "the command again."
        )
