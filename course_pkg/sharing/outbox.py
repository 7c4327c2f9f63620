"""The outbox: one file for each result of a check that the class service has not stored yet."""

from __future__ import annotations

import json
import os
import secrets
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from course_pkg.state import state_folder, write_json

FOLDER = "class-outbox"
LONGEST_HINT = 500  # The length is in characters.
LARGEST = 20_000  # maximum size of a file in bytes; the method `put` writes smaller files
KEPT = 30 * 86_400  # time in s after which an unsent result is deleted


class Outbox:
    """The results that the service has not stored yet. The name of a file is the id of its result."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or state_folder() / FOLDER

    def put(self, report: Mapping[str, object]) -> str:
        """Add the result of a check; return an error message if the file cannot be written, else "".

        The result contains the part, the verdict, the time and the hint. The result does not contain the
        student's code or the values that the code computed.
        """
        name = f"{time.time_ns():020}-{secrets.token_hex(4)}"
        shared = {
            "id": name,
            "check": report.get("check"),
            "verdict": report.get("verdict"),
            "time": time.time(),
            "hint": _hint(report),
        }
        try:
            write_json(self.folder / f"{name}.json", shared)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            return (
                f"This result is not shared with your teacher, because {self.folder} cannot be written "
                f"({reason})."
            )
        return ""

    def first(self, most: int) -> list[dict[str, object]]:
        """Return the oldest results; `most` is their maximum number.

        The method also deletes files that are too old or contain no result.

        Raises OSError if the folder cannot be read.
        """
        try:
            names = sorted(entry.name for entry in os.scandir(self.folder) if entry.name[0] != ".")
        except FileNotFoundError:
            return []
        found: list[dict[str, object]] = []
        for name in names:
            if len(found) == most:
                break
            path = self.folder / name
            if (data := _read(path)) is None:
                path.unlink(missing_ok=True)
            else:
                found.append(data)
        return found

    def remove(self, ids: Sequence[str]) -> None:
        """Delete results that the service has stored. Raises OSError if a file cannot be deleted."""
        for each in ids:
            (self.folder / f"{each}.json").unlink(missing_ok=True)


def _hint(report: Mapping[str, object]) -> str:
    """Return the hint or the text of the first assertion that fails, or "" if all assertions hold."""
    assertions = report.get("assertions")
    for each in assertions if isinstance(assertions, Sequence) else ():
        if not each["holds"]:
            return str(each.get("hint") or each.get("text"))[:LONGEST_HINT]
    return ""


def _read(path: Path) -> dict[str, object] | None:
    """Return the result in a file, or None if the file is too old or contains no result."""
    try:
        status = path.stat()
        if status.st_size > LARGEST or time.time() - status.st_mtime > KEPT:
            return None
        data = json.loads(path.read_text("utf-8"))
    except (ValueError, RecursionError):
        return None
    return data if isinstance(data, dict) and f"{data.get('id')}.json" == path.name else None
