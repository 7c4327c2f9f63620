"""The settings of an autograder, and the times in Gradescope's metadata for a submission."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.deadline import Deadlines
from course_pkg.grading.deadlines.late import LatePolicy
from course_pkg.grading.deadlines.moments import moment_of


@dataclass(frozen=True)
class Settings:
    """The settings in settings.json; `course autograder` writes them, and the container reads them."""

    chapters: tuple[str, ...]
    minutes: float  # `minutes` is the time limit of a run; Gradescope's time limit must be longer.
    late_per_day: float | None = None  # The deduction is in percent.
    late_max_days: float | None = None

    @property
    def policy(self) -> LatePolicy | None:
        """The deduction for lateness, or None if late submissions lose no points."""
        if self.late_per_day is None and self.late_max_days is None:
            return None
        most = math.inf if self.late_max_days is None else self.late_max_days
        return LatePolicy(self.late_per_day or 0.0, most)

    def as_json(self) -> str:
        """Return the text of settings.json."""
        return json.dumps(asdict(self), indent=1) + "\n"


def read_settings(path: Path) -> Settings:
    """Return the settings in the file at the path `path`; raise GradingError if the file is damaged."""
    try:
        known = json.loads(path.read_text("utf-8"))
        return Settings(**{**known, "chapters": tuple(known["chapters"])})
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise GradingError(f"The autograder's {path.name} is damaged: {error}.") from error


def days_late(metadata: Path) -> float | None:
    """Return the number of days by which the submission is late, or None without usable times in `metadata`.

    If the student has an extension, Gradescope's metadata contain the student's own deadline. Format:
    https://gradescope-autograders.readthedocs.io/en/latest/submission_metadata/.
    """
    try:
        known = json.loads(metadata.read_text("utf-8"))
        own = [user["assignment"] for user in known.get("users", []) if user.get("assignment")]
        due = max(filter(None, map(_due, own)), default=None) or _due(known["assignment"])
        submitted = moment_of(known["created_at"], None)
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        return None
    if due is None or submitted is None:
        return None
    return Deadlines({"": due}).days_late("", "", submitted)


def _due(assignment: Mapping[str, str | None]) -> datetime | None:
    return moment_of(assignment.get("due_date") or "", None)
