"""The student's own record: a file for each part, with the last result and the time of the first pass.

The record shows students their progress in the course. Students can change the record, because it is in their
own folder. The record is therefore never used for a grade.

Grades come from check runners that `course grade` starts. A rule of import-linter in pyproject.toml forbids
the packages grading and sandbox to import this module.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from course_pkg.ros.protocol.json_channel import Json
from course_pkg.state import locked, now, state_folder, write_json

FOLDER = "results-2"  # The folder `results` belongs to the first edition, which had other chapter numbers.
PASSED = "passed"


@dataclass(frozen=True)
class PartRecord:
    """The results of the checks of one part. A time is ISO 8601 in UTC, or "" if the time is unknown."""

    check: str
    verdict: str
    checked: str
    passed: str  # A check of the part passed for the first time at this time.
    checks: int
    points: float = 0  # These are the points of the last check.


class DamagedRecord(Exception):
    """A file of the record cannot be read, or its content is not a record."""


class StudentRecord:
    """The results of the checks that this student has run, in a folder of the course's state."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or state_folder() / FOLDER

    def store(self, check: str, result: Mapping[str, Json]) -> str:
        """Store the result of a check; return a message if there was a problem, or "".

        A damaged file is renamed, not deleted. If the file cannot be written, the old file does not change.
        This method raises no error, because the report of a check must not depend on the record.
        """
        path = self._path(check)
        try:
            with locked(self.folder):
                before, message = self._before(check)
                first = (before and before.passed) or (now() if result.get("verdict") == PASSED else "")
                kept = {"checked": now(), "passed": first, "checks": (before.checks if before else 0) + 1}
                write_json(path, {**result, **kept})
        except (OSError, ValueError) as error:
            return (
                f"This result was not stored, because {path} cannot be written "
                f"({getattr(error, 'strerror', None) or error}). Solve this problem, and run "
                "this cell again."
            )
        return message

    def read(self, checks: Iterable[str]) -> tuple[dict[str, PartRecord], str]:
        """Return a dict with the record of each part, and a message about damaged records or ""."""
        found: dict[str, PartRecord] = {}
        damaged: dict[str, list[str]] = {}
        for check in checks:
            try:
                if record := self._read(check):
                    found[check] = record
            except DamagedRecord as error:
                damaged.setdefault(str(error), []).append(check)
        reasons = "; ".join(f"{_listed(parts)}: {reason}" for reason, parts in damaged.items())
        message = (
            f"Some results in {self.folder} cannot be read ({reasons}). Run the checks of "
            "these parts again. The course then stores new results, and keeps the old files in "
            "the same folder."
        )
        return found, message if damaged else ""

    def _path(self, check: str) -> Path:
        return self.folder / f"{check}.json"

    def _before(self, check: str) -> tuple[PartRecord | None, str]:
        """Return (stored record of a part, ""), or (None, message about a damaged file).

        A damaged file is renamed.
        """
        try:
            return self._read(check), ""
        except DamagedRecord as error:
            path = self._path(check)
            names = (path.with_name(f"{check}.damaged-{number}.json") for number in count(1))
            aside = next(name for name in names if not name.exists())
            path.rename(aside)
            return None, (
                f"The earlier result of this part could not be read ({error}). The old file "
                f"was renamed to {aside}, and the new result was stored."
            )

    def _read(self, check: str) -> PartRecord | None:
        """Return the record of a part, or None if there is no record.

        Raises DamagedRecord if the file cannot be read or contains no record.
        """
        try:
            data = json.loads(self._path(check).read_text("utf-8"))
        except FileNotFoundError:
            return None
        except (OSError, ValueError, RecursionError) as error:
            raise DamagedRecord(_reason(error)) from error
        record = _record(check, data)
        if record is None:
            raise DamagedRecord("it does not contain a record")
        return record


def _record(check: str, data: object) -> PartRecord | None:
    """Return the record of a part in `data`, or None if store() has not written `data`."""
    if not isinstance(data, dict):
        return None
    texts = [data.get(name) for name in ("verdict", "checked", "passed")]
    checks = data.get("checks")
    if data.get("check") != check or type(checks) is not int:
        return None
    if not all(isinstance(text, str) for text in texts):
        return None
    verdict, checked, passed = map(str, texts)
    points = data.get("points")
    earned = points if isinstance(points, (int, float)) and math.isfinite(points) else 0
    return PartRecord(check, verdict, checked, passed, checks, earned)


def _reason(error: Exception) -> str:
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return "it is not valid JSON"


def _listed(parts: list[str], most: int = 5) -> str:
    """Return the ids of the first `most` parts as text, and the number of further parts."""
    more = f" and {len(parts) - most} more" if len(parts) > most else ""
    return ", ".join(parts[:most]) + more
