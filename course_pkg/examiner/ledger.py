"""The book of rules that a check keeps: each rule once, until the first that does not hold."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from typing import NoReturn

from course_pkg.examiner.plain import Plain, Value, plain
from course_pkg.examiner.report import Rule

Recognised = Value  # a wrong value, a compiled pattern, or a predicate on what was seen
Hints = str | Mapping[Recognised, str] | Iterable[tuple[Recognised, str]]


class RuleBroken(Exception):
    """A rule does not hold: the check is over."""


def says(pattern: str) -> re.Pattern[str]:
    """Return a pattern for `hints`: it recognises a text in which `pattern` occurs, in any case."""
    return re.compile(pattern, re.IGNORECASE | re.DOTALL)


def same(expected: Plain, seen: Plain, near: float = 0.0) -> bool:
    """Return whether plain data are equal; numbers within `near`, relative or absolute, True never 1."""
    if isinstance(expected, dict) and isinstance(seen, dict):
        return expected.keys() == seen.keys() and all(
            same(expected[key], seen[key], near) for key in expected
        )
    if isinstance(expected, list) and isinstance(seen, list):
        return len(expected) == len(seen) and all(map(lambda a, b: same(a, b, near), expected, seen))
    if isinstance(expected, bool) or isinstance(seen, bool):
        return expected is seen
    if isinstance(expected, (int, float)) and isinstance(seen, (int, float)):
        with suppress(OverflowError):  # a whole number that is too large for a float is near to none
            return expected == seen or math.isclose(expected, seen, rel_tol=near, abs_tol=near)
        return False
    return type(expected) is type(seen) and bool(expected == seen)


def first_unlike(expected: Iterable[Plain], seen: Iterable[Plain], near: float) -> tuple[Plain, Plain]:
    """Return the first two of a place that are not the same: a whole list says little. ({}, {}) for none."""
    pairs = zip(expected, seen, strict=False)
    return next((pair for pair in pairs if not same(*pair, near)), ({}, {}))


def hint_for(hints: Hints, seen: Plain, near: float = 0.0) -> str:
    """Return the first of `hints` that recognises `seen`, or an empty text."""
    if isinstance(hints, str):
        return hints
    pairs = hints.items() if isinstance(hints, Mapping) else hints
    return next((text for recognised, text in pairs if _recognises(recognised, seen, near)), "")


def _recognises(recognised: Recognised, seen: Plain, near: float) -> bool:
    if isinstance(recognised, re.Pattern):
        return bool(recognised.search(str(seen)))
    if isinstance(recognised, Callable):  # type: ignore[arg-type]
        try:
            return bool(recognised(seen))
        except (TypeError, ValueError, LookupError, AttributeError):  # it expects another kind of value
            return False
    return same(plain(recognised), seen, near)


class Ledger:
    """The rules looked at so far, and what was asked last."""

    def __init__(self) -> None:
        self.asked: Callable[[], str] = str  # worded only when a rule does not hold
        self._rules: dict[str, Rule] = {}

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules, in the order in which they were first looked at."""
        return tuple(self._rules.values())

    def passes(self, rule: str) -> None:
        """Note that `rule` holds (so far: a later look at it may find that it does not)."""
        self._rules.setdefault(rule, Rule(rule, holds=True))

    def fails(self, rule: str, *, expected: str = "", seen: str = "", hint: str = "") -> NoReturn:
        """Note that `rule` does not hold, and end the check."""
        self._rules.pop(rule, None)
        self._rules[rule] = Rule(rule, False, self.asked(), expected, seen, hint)
        raise RuleBroken(rule)
