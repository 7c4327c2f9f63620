"""Reads dates and times in the formats that the platforms write."""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone, tzinfo
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from course_pkg.errors import GradingError

ISO = re.compile(
    r"(?P<day>\d{4}-\d\d-\d\d)[T ](?P<time>\d\d:\d\d(?::\d\d)?)(?:\.\d+)?"
    r"\s*(?P<zone>Z|UTC|GMT|[+-]\d\d:?\d\d)?",
    re.IGNORECASE,
)
OFFSET = re.compile(r"(?:UTC)?([+-])(\d\d):?(\d\d)", re.IGNORECASE)
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
# Moodle writes "Sunday, 1 November 2026, 11:59 PM"; in some languages, the month comes before the day.
WRITTEN = re.compile(
    r"(?:[a-z]+,?\s+)?(?:(?P<day>\d{1,2})\.?\s+(?P<month>[a-z]{3,9})|(?P<month2>[a-z]{3,9})\s+(?P<day2>\d{1,2})),?\s+"
    r"(?P<year>\d{4}),?\s+(?:at\s+)?(?P<hour>\d{1,2}):(?P<minute>\d\d)(?::\d\d)?\s*(?P<half>[ap]\.?m\.?)?",
    re.IGNORECASE,
)


def zone_of(name: str) -> tzinfo:
    """Return a time zone such as "Europe/Berlin" or "+01:00"; raise GradingError if the name is unknown."""
    if found := OFFSET.fullmatch(name):
        minutes = int(found[2]) * 60 + int(found[3])
        return timezone(timedelta(minutes=-minutes if found[1] == "-" else minutes))
    if name.upper() in ("Z", "UTC", "GMT"):
        return timezone.utc
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError) as error:
        raise GradingError(
            f"{name} is not a time zone. Give a name such as Europe/Berlin, or an offset such as +01:00."
        ) from error


def moment_of(text: str, zone: tzinfo | None) -> datetime | None:
    """Return the date and time in `text`, or None if `text` does not contain a date and time.

    `zone` is used if the text contains no time zone. If there is no time zone in `text` and `zone` is None,
    the result is None. At the end of summer time, one hour occurs twice. For a time in this hour, the result
    is the earlier time.
    """
    text = " ".join(text.split())
    if found := ISO.fullmatch(text):
        own = zone_of(found["zone"]) if found["zone"] else zone
        return _made(f"{found['day']}T{found['time']}", own)
    if found := WRITTEN.fullmatch(text):
        month = (found["month"] or found["month2"]).lower()[:3]
        day = int(found["day"] or found["day2"])
        hour = int(found["hour"])
        if found["half"]:
            hour = hour % 12 + (12 if found["half"].lower().startswith("p") else 0)
        if month in MONTHS:
            number = MONTHS.index(month) + 1
            return _made(f"{found['year']}-{number:02}-{day:02}T{hour:02}:{found['minute']}", zone)
    return None


def shown(moment: datetime) -> str:
    """Return a point in time as text for reports, with the offset from UTC: 2026-11-01 23:59 +01:00."""
    offset = moment.strftime("%z")
    return f"{moment:%Y-%m-%d %H:%M} {offset[:3]}:{offset[3:5]}"


def _made(iso: str, zone: tzinfo | None) -> datetime | None:
    if zone is None:
        return None
    try:
        return datetime.fromisoformat(iso).replace(tzinfo=zone)
    except ValueError:
        return None
