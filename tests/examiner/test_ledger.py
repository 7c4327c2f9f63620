"""Rules are told once, the first that does not hold ends the check, and hints recognise what was seen."""

from __future__ import annotations

import math
from typing import Any

import pytest

from course_pkg.examiner.ledger import Ledger, RuleBroken, hint_for, same, says


@pytest.mark.parametrize(
    ("expected", "seen", "near"),
    [
        (1, 1.0, 0.0),
        (1.25, 1.2500001, 1e-3),
        ({"a": [1.0, "x"]}, {"a": [1.0004, "x"]}, 1e-3),
        (math.inf, math.inf, 0.0),
    ],
)
def test_same(expected: Any, seen: Any, near: float) -> None:  # noqa: ANN401
    """Numbers are compared as numbers, at any depth, within what is allowed."""
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
def test_not_same(expected: Any, seen: Any) -> None:  # noqa: ANN401
    """True is not 1, an empty list no empty dict, nothing equals NaN."""
    assert not same(expected, seen, 1e-3)


def test_hints_recognise_values_words_and_what_a_predicate_says() -> None:
    """The first that fits counts, and a predicate for another kind of value does not fit."""
    hints = [
        (3.5, "value"),
        (says("boom.*bang"), "words"),
        (lambda seen: seen < 0, "negative"),
        (None, "nothing"),
    ]
    assert hint_for(hints, 3.5001, near=1e-3) == "value"
    assert hint_for(hints, "it went BOOM and\nbang") == "words"
    assert hint_for(hints, -1) == "negative"
    assert hint_for(hints, None) == "nothing"
    assert hint_for(hints, "something else") == ""
    assert hint_for("always", 7) == "always"


def test_a_rule_is_told_once_and_may_fail_later() -> None:
    """A rule that is looked at for each of three inputs is one line; when the third fails, it fails."""
    ledger = Ledger()
    ledger.passes("a")
    ledger.passes("b")
    ledger.passes("a")
    assert [rule.text for rule in ledger.rules] == ["a", "b"]
    with pytest.raises(RuleBroken):
        ledger.fails("a", seen="wrong")
    assert [(rule.text, rule.holds) for rule in ledger.rules] == [("b", True), ("a", False)]
