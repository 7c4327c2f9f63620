"""The deadlines of chapters, with a grace period and the extensions of students."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta, tzinfo

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.extensions import Extensions
from course_pkg.grading.deadlines.moments import moment_of

OPTION = re.compile(r"(?:(?P<chapter>\d{1,2})=)?(?P<time>.+)")
DAY = 86_400.0  # The time is in s.


@dataclass(frozen=True)
class Deadlines:
    """The deadlines of chapters; the deadline with the key "" applies to all other chapters."""

    by_chapter: Mapping[str, datetime]
    grace: timedelta = timedelta()
    extensions: Extensions = field(default_factory=Extensions)

    def due(self, student: str, chapter: str) -> datetime | None:
        """Return a student's deadline for a chapter, or None if the chapter has no deadline.

        The returned time does not include the grace period.

        An extension keeps the time of day of a deadline, even if summer time begins or ends in between.
        """
        deadline = self.by_chapter.get(chapter, self.by_chapter.get(""))
        if deadline is None:
            return None
        return deadline + timedelta(days=self.extensions.days(student))

    def is_over(self, student: str, chapter: str) -> bool:
        """Return whether a student's deadline for a chapter has passed; without a deadline, return True."""
        due = self.due(student, chapter)
        return due is None or due + self.grace <= datetime.now(due.tzinfo)

    def days_late(self, student: str, chapter: str, submitted: datetime) -> float:
        """Return the number of days from the end of the grace period to the submission; at least 0."""
        due = self.due(student, chapter)
        if due is None:
            return 0.0
        seconds = submitted.timestamp() - due.timestamp() - self.grace.total_seconds()
        return max(0.0, seconds / DAY)


def deadlines(
    given: Sequence[str], grace_minutes: float, zone: tzinfo | None, extensions: Extensions
) -> Deadlines:
    """Return the deadlines that the options --deadline and --grace-minutes set.

    Each item of `given` is a time, or a chapter and a time, such as 05=2026-11-01T23:59+01:00. Raises
    GradingError if a deadline has no time zone, is not a time, or is given twice.
    """
    if grace_minutes and not given:
        raise GradingError("--grace-minutes needs a deadline. Add the option --deadline TIME.")
    if not 0 <= grace_minutes < 100_000:
        raise GradingError(
            f"--grace-minutes {grace_minutes:g} is not a number of minutes. Give a number of at least 0."
        )
    found: dict[str, datetime] = {}
    for option in given:
        match = OPTION.fullmatch(option.strip())
        chapter = (match["chapter"] or "").zfill(2) if match and match["chapter"] else ""
        written = match["time"] if match else option
        moment = moment_of(written, zone)
        if moment is None:
            raise GradingError(_wrong(option, written))
        if chapter in found:
            raise GradingError(
                f"--deadline {option}: the same chapter has two deadlines. Give only one deadline for "
                "each chapter."
            )
        found[chapter] = moment
    return Deadlines(found, timedelta(minutes=grace_minutes), extensions)


def _wrong(option: str, written: str) -> str:
    example = "2026-11-01T23:59+01:00"
    from_utc = moment_of(written, zone=datetime.now().astimezone().tzinfo)
    if from_utc is not None:
        return (
            f"--deadline {option} has no time zone. Add the offset from UTC, such as {example}, or "
            "add an option such as --time-zone Europe/Berlin."
        )
    return f"--deadline {option} is not a time. Write {example}, or 05={example} for chapter 05 only."
