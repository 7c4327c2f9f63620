"""Tests of the time formats of the platforms."""

from __future__ import annotations

from datetime import datetime, timezone

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.moments import moment_of, shown, zone_of

BERLIN = zone_of("Europe/Berlin")


@pytest.mark.parametrize(
    ("written", "utc"),
    [
        ("2026-11-01T23:59+01:00", "2026-11-01T22:59"),
        ("2026-11-01T23:59:00+0100", "2026-11-01T22:59"),
        ("2026-11-01 22:59:30 Z", "2026-11-01T22:59:30"),
        ("2026-11-01 22:59:30.123456 UTC", "2026-11-01T22:59:30"),  # the format of nbgrader
        ("2026-11-01 22:59:30.123456000 Z", "2026-11-01T22:59:30"),  # the format of Gradescope
        ("2026-11-01 15:59:30.123456 -07:00", "2026-11-01T22:59:30"),
        ("2026-11-01 23:59", "2026-11-01T22:59"),
        ("2026-07-01 23:59", "2026-07-01T21:59"),
        ("Sunday, 1 November 2026, 11:59 PM", "2026-11-01T22:59"),  # the format of Moodle
        ("Sunday, November 1, 2026, 11:59 PM", "2026-11-01T22:59"),
        ("Sunday, 1 November 2026, 23:59", "2026-11-01T22:59"),
        ("Sunday, 1 November 2026, 12:05\u202fAM", "2026-10-31T23:05"),
        ("1 Nov 2026, 12:05 p.m.", "2026-11-01T11:05"),
        # The local time 02:30 occurs twice on this day; the result is the earlier time.
        ("2026-10-25 02:30", "2026-10-25T00:30"),
    ],
)
def test_the_forms(written: str, utc: str) -> None:
    """If a text contains a time without a time zone, the time is in the given time zone."""
    moment = moment_of(written, BERLIN)
    assert moment is not None
    assert moment.astimezone(timezone.utc) == datetime.fromisoformat(utc).replace(tzinfo=timezone.utc)


@pytest.mark.parametrize(
    "written", ["", "-", "tomorrow", "2026-11-01", "2026-13-01 10:00", "1 Foo 2026, 10:00"]
)
def test_no_time(written: str) -> None:
    """If a text is not a time, the result is None."""
    assert moment_of(written, BERLIN) is None


def test_a_time_without_any_zone() -> None:
    """If the text and the argument contain no time zone, the result is None."""
    assert moment_of("2026-11-01 23:59", None) is None
    assert moment_of("2026-11-01 23:59 Z", None) is not None


def test_zones() -> None:
    """A time zone is given as a name, or as an offset from UTC."""
    assert zone_of("-05:30").utcoffset(None) == zone_of("UTC-0530").utcoffset(None)
    for wrong in ("Mars/Base", "../etc/passwd", "+1"):
        with pytest.raises(GradingError, match=r"Europe/Berlin"):
            zone_of(wrong)


def test_a_report_shows_the_offset() -> None:
    """The text for a time contains the offset from UTC."""
    moment = moment_of("2026-11-01 23:59", BERLIN)
    assert moment is not None
    assert shown(moment) == "2026-11-01 23:59 +01:00"
