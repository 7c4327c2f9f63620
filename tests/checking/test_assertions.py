"""Tests of the assertions in a check."""

from __future__ import annotations

import math

import pytest

from course_pkg.checking.assertions import AssertionFailed, Results, hint_for, matches, same
from course_pkg.ros.protocol.json_channel import Json


@pytest.mark.parametrize(
    ("expected", "seen", "near"),
    [
        (1, 1.0, 0.0),
        (1.25, 1.2500001, 1e-3),
        ({"a": [1.0, "x"]}, {"a": [1.0004, "x"]}, 1e-3),
        (math.inf, math.inf, 0.0),
    ],
)
def test_same(expected: Json, seen: Json, near: float) -> None:
    """Numbers are compared by value, within a tolerance, even inside lists and dicts."""
    assert same(expected, seen, near)


@pytest.mark.parametrize(
    ("expected", "seen"),
    [
        (1, True),
        (True, 1),
        (0, None),
        ("1", 1),
        ([1, 2], [1]),
        ({"a": 1}, {"a": 1, "b": 2}),
        (1.0, math.nan),
        (1.0, 1.1),
        ([], {}),
    ],
)
def test_not_same(expected: Json, seen: Json) -> None:
    """True is not equal to 1, an empty list is not equal to an empty dict, and no value is equal to NaN."""
    assert not same(expected, seen, 1e-3)


def test_hint_of_the_first_matching_condition() -> None:
    """The first condition that is true selects the hint."""
    hints = [
        (3.5, "value"),
        (matches("boom.*bang"), "words"),
        (lambda actual: actual < 0, "negative"),
        (None, "nothing"),
    ]
    assert hint_for(hints, 3.5001, near=1e-3) == "value"
    assert hint_for(hints, "it went BOOM and\nbang") == "words"
    assert hint_for(hints, -1) == "negative"
    assert hint_for(hints, None) == "nothing"
    assert hint_for(hints, "something else") == ""
    assert hint_for("always", 7) == "always"


def test_assertion_is_reported_once_and_may_fail_later() -> None:
    """If a check uses an assertion several times, the report contains the assertion once.

    If an assertion fails once, it counts as failed for the whole check.
    """
    results = Results()
    results.passes("a")
    results.passes("b")
    results.passes("a")
    assert [assertion.text for assertion in results.assertions] == ["a", "b"]
    with pytest.raises(AssertionFailed):
        results.fails("a", actual="wrong")
    assert [(each.text, each.holds) for each in results.assertions] == [
        ("b", True),
        ("a", False),
    ]
