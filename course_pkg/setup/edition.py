"""Which edition of the course a folder holds: the instructors', or a students' one from `course release`."""

from __future__ import annotations

import json
from pathlib import Path

from course_pkg.errors import SetupError

RECORD = ".course-release.json"  # in a students' edition: which chapters and files it consists of


def released_chapters(checkout: Path) -> tuple[str, ...] | None:
    """Return the chapters of a students' edition, such as ("05", "06"); None for the instructors' edition."""
    try:
        return tuple(map(str, json.loads((checkout / RECORD).read_text("utf-8"))["chapters"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None


def require_solutions(checkout: Path, command: str) -> None:
    """Raise SetupError if `command` cannot work in `checkout`, because there are no solutions."""
    if (checkout / RECORD).exists():
        raise SetupError(
            f"`course {command}` needs the solutions, and {checkout} is the students' edition, which has "
            "none. Type the command in the instructors' edition, where `course release` was typed."
        )
    if not any((checkout / "solutions").glob("[0-9][0-9]_*.ipynb")):
        raise SetupError(
            f"`course {command}` needs the solutions, but there are none in {checkout / 'solutions'}. "
            "Get that folder from the course's repository, and type the command again."
        )
