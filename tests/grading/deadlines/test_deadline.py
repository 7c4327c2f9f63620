"""Tests of deadlines and extensions, and of the choice between several attempts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.deadline import Deadlines, deadlines
from course_pkg.grading.deadlines.extensions import Extensions, extensions_of
from course_pkg.grading.deadlines.late import late_policy
from course_pkg.grading.deadlines.lateness import Lateness, attempts_to_grade, best_attempts
from course_pkg.grading.deadlines.moments import moment_of, zone_of
from course_pkg.grading.grade import NO_TIME, Submission
from course_pkg.grading.intake.submissions import submissions
from course_pkg.grading.roster.class_list import read_lists
from course_pkg.grading.roster.people import Person
from tests.grading.grades import class_of
from tests.grading.handing_in import NAMES, folder, handed_out, raw

DUE = "2026-11-01T23:59+01:00"
FILE = NAMES["05"]


def _at(text: str) -> datetime:
    moment = moment_of(text, timezone.utc)
    assert moment is not None
    return moment


def _deadlines(*given: str, grace: float = 0.0, extensions: Extensions | None = None) -> Deadlines:
    return deadlines(given or (DUE,), grace, None, extensions or Extensions())


@pytest.mark.parametrize(
    ("submitted", "grace", "days"),
    [
        ("2026-11-01T22:59Z", 0, 0.0),
        ("2026-11-01T23:59+01:00", 0, 0.0),
        ("2026-11-02T11:59+01:00", 0, 0.5),
        ("2026-11-02T00:14+01:00", 15, 0.0),
        ("2026-11-03T00:14+01:00", 15, 1.0),
    ],
)
def test_days_late(submitted: str, grace: float, days: float) -> None:
    """The number of late days is counted from the end of the grace period, even with different time zones."""
    assert _deadlines(grace=grace).days_late("s01", "05", _at(submitted)) == pytest.approx(days)


def test_one_second_late_costs_a_day() -> None:
    """A submission that is one second late counts as one whole day late."""
    late = _deadlines().days_late("s01", "05", _at("2026-11-01T23:59:01+01:00"))
    assert late_policy(None, 10, None, [DUE]).factor(late) == pytest.approx(0.9)


def test_a_deadline_for_a_chapter() -> None:
    """A chapter's own deadline replaces the general deadline."""
    both = _deadlines(DUE, "6=2026-11-08T23:59+01:00")
    assert both.days_late("s01", "05", _at("2026-11-02T23:59+01:00")) == pytest.approx(1.0)
    assert both.days_late("s01", "06", _at("2026-11-02T23:59+01:00")) == 0.0
    assert _deadlines("06=" + DUE).due("s01", "05") is None


def test_an_extension_ends_at_the_same_time_of_day() -> None:
    """Even if daylight saving time ends during an extension, the deadline stays at 23:59."""
    extensions = Extensions({"s01": 2.0})
    made = deadlines(["2026-10-24T23:59"], 0.0, zone_of("Europe/Berlin"), extensions)
    assert made.days_late("s01", "05", _at("2026-10-26T22:59Z")) == 0.0
    assert made.days_late("s01", "05", _at("2026-10-27T22:59Z")) == pytest.approx(1.0)
    assert made.days_late("s02", "05", _at("2026-10-25T22:59Z")) == pytest.approx(25 / 24)


@pytest.mark.parametrize(
    ("given", "grace", "said"),
    [
        (["2026-11-01T23:59"], 0, r"no time zone.*--time-zone Europe/Berlin"),
        (["tomorrow"], 0, r"is not a time. Write 2026-11-01T23:59\+01:00"),
        (["xx=" + DUE], 0, "is not a time"),
        ([DUE, DUE], 0, "two deadlines"),
        ([DUE], -1, "--grace-minutes -1"),
        ([DUE], float("nan"), "--grace-minutes nan"),
    ],
)
def test_a_deadline_that_makes_no_sense(given: list[str], grace: float, said: str) -> None:
    """If a deadline is invalid, the error message contains a correct example."""
    with pytest.raises(GradingError, match=said):
        deadlines(given, grace, None, Extensions())


def test_extensions_of_a_roster(tmp_path: Path) -> None:
    """The column extension_days moves a student's deadline to a later day."""
    path = tmp_path / "roster.csv"
    path.write_text("name;id;username;extension_days\nA One;17;aone;1,5\nA Two;18;atwo;\n", "utf-8")
    students = {name: [f"{name}/{FILE}"] for name in ("aone", "A Two", "other")}
    found = extensions_of(read_lists(path, None).matched(students).people)
    assert [found.days(each) for each in students] == [1.5, 0.0, 0.0]


@pytest.mark.parametrize("written", ["two", "-1", "nan"])
def test_a_broken_extension(written: str) -> None:
    """If an extension is invalid, the error message contains the line number, but no student's name."""
    person = Person("secret", line=3, more={"extension days": written})
    with pytest.raises(GradingError, match=r"Line 3 of the roster: .* extension_days is not") as caught:
        extensions_of({"secret": person})
    assert "secret" not in str(caught.value)


def _lateness(times: Mapping[str, str], **more: Deadlines) -> Lateness:
    found = {origin: _at(text) for origin, text in times.items()}
    return Lateness(more.get("due", _deadlines()), lambda each: found.get(each.origin))


def _submission(student: str, origin: str = "") -> Submission:
    return Submission(student, "05", b"x", origin or student)


def test_the_note_says_when() -> None:
    """The note of a late submission contains the deadline, the time of submission and the extension."""
    due = _deadlines(extensions=Extensions({"s01": 1.0}))
    lateness = _lateness({"s01": "2026-11-03T23:59+01:00", "s02": "2026-11-01T10:00Z"}, due=due)
    late, early = lateness.applied([_submission("s01"), _submission("s02")])
    assert late.late == pytest.approx(1.0)
    assert late.notes == (
        "This chapter was handed in at 2026-11-03 23:59 +01:00. The deadline was 2026-11-02 23:59 +01:00, "
        "with an extension of 1 day.",
    )
    assert (early.late, early.notes) == (0.0, ())


def test_a_time_that_is_not_known() -> None:
    """A submission without a known time counts as on time and gets a note.

    If all times are missing, grading stops with an error.
    """
    known, unknown = _lateness({"s01": DUE}).applied([_submission("s01"), _submission("s02")])
    assert (known.notes, unknown.notes, unknown.late) == ((), (NO_TIME,), 0.0)
    with pytest.raises(GradingError, match="--deadline needs the submission times"):
        _lateness({}).applied([_submission("s01")])


def test_without_a_deadline_nothing_is_late() -> None:
    """Without a deadline, submissions need no times."""
    given = [_submission("s01")]
    assert Lateness(_deadlines("06=" + DUE), lambda _: None).applied(given) == given


def test_the_last_attempt_by_time(tmp_path: Path) -> None:
    """The program grades the attempt with the latest time, and a note names the other attempt."""
    content = raw(handed_out())
    source = folder(tmp_path, {f"s01/a/{FILE}": content, f"s01/b/{FILE}": content})
    (given,) = submissions(source)
    times = {f"s01/a/{FILE}": _at("2026-11-01T12:00Z"), f"s01/b/{FILE}": _at("2026-11-01T10:00Z")}
    (chosen,) = attempts_to_grade([given], "last", lambda each: times[each.origin])
    assert chosen.origin == f"s01/a/{FILE}"
    assert chosen.notes == (
        f"This chapter was handed in 2 times: {chosen.origin} was handed in last and was graded. "
        f"These files do not count: s01/b/{FILE}.",
    )
    assert attempts_to_grade([given], "last", lambda _: None) == [given]


def test_the_best_attempt_counts_after_lateness(tmp_path: Path) -> None:
    """All attempts are graded, and the attempt with the most points counts."""
    content = raw(handed_out())
    names = [f"s01/{FILE.replace('.ipynb', f'{end}.ipynb')}" for end in ("", "-1", "-2")]
    (given,) = submissions(folder(tmp_path, dict.fromkeys(names, content)))
    tried = attempts_to_grade([given], "best", lambda _: None)
    assert [each.origin for each in tried] == [names[2], names[0], names[1]]
    (grade,) = class_of(1)
    full = replace(grade, origin=names[0], factor=0.5)
    last = replace(grade, origin=names[2], factor=0.9)
    (best,) = best_attempts([full, last])
    assert best.origin == names[2]
    assert best.notes[-1] == (
        f"This chapter was handed in 2 times: {names[2]} has the most points and counts. These files do not "
        f"count: {names[0]}."
    )
    assert best_attempts([grade]) == [grade]
