"""The assertions of a check, and the hints for assertions that do not hold."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from typing import Any, NoReturn, TypeAlias

from course_pkg.checking.plain_values import plain
from course_pkg.checking.report import Assertion
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.types import Plain

# A wrong value, a pattern made by `matches`, or a function that returns whether the actual value matches. If
# such a function raises an exception, for example because the value has another type, the value does not
# match.
Condition: TypeAlias = "Plain | bytes | re.Pattern[str] | Callable[[Any], object]"
ANYTHING: Condition = re.compile("")  # matches every value; used for the last hint of a list
# One hint for every wrong value, or pairs: the first condition that matches selects the hint.
Hints: TypeAlias = "str | Sequence[tuple[Condition, str]]"


class AssertionFailed(Exception):
    """An assertion does not hold, so the check ends, or the goal in which it is."""


def matches(pattern: str) -> re.Pattern[str]:
    """Return a condition for `hints`: it matches a value whose text contains `pattern`; case is ignored."""
    return re.compile(pattern, re.IGNORECASE | re.DOTALL)


def same(expected: Json, actual: Json, near: float = 0.0) -> bool:
    """Return whether plain values are equal.

    Numbers may differ by `near`, relative or absolute. True is not equal to 1.
    """
    if isinstance(expected, dict) and isinstance(actual, dict):
        return expected.keys() == actual.keys() and all(
            same(expected[key], actual[key], near) for key in expected
        )
    if isinstance(expected, list) and isinstance(actual, list):
        return len(expected) == len(actual) and all(map(lambda a, b: same(a, b, near), expected, actual))
    if isinstance(expected, bool) or isinstance(actual, bool):
        return expected is actual
    if isinstance(expected, (int, float)) and isinstance(actual, (int, float)):
        # an integer that is too large for a float is not near to any other number
        with suppress(OverflowError):
            return expected == actual or math.isclose(expected, actual, rel_tol=near, abs_tol=near)
        return False
    return type(expected) is type(actual) and bool(expected == actual)


def first_unlike(expected: Iterable[Json], actual: Iterable[Json], near: float) -> tuple[Json, Json]:
    """Return the first pair of different items, so that a report need not show whole lists.

    Returns ({}, {}) if all pairs are the same.
    """
    pairs = zip(expected, actual, strict=False)
    return next((pair for pair in pairs if not same(*pair, near)), ({}, {}))


def hint_for(hints: Hints, actual: Json, near: float = 0.0) -> str:
    """Return the hint of the first condition that matches `actual`, or an empty string."""
    if isinstance(hints, str):
        return hints
    return next((hint for condition, hint in hints if _fits(condition, actual, near)), "")


def _fits(condition: Condition, actual: Json, near: float) -> bool:
    if isinstance(condition, re.Pattern):
        return bool(condition.search(str(actual)))
    if callable(condition):
        try:
            return bool(condition(actual))
        # The condition expects a value of another type.
        except (TypeError, ValueError, LookupError, AttributeError):
            return False
    return same(plain(condition), actual, near)


class Results:
    """The assertions that were checked, and the last call of the check."""

    def __init__(self) -> None:
        # returns the text of the call, which is needed only when a check fails
        self.asked: Callable[[], str] = str
        self._assertions: dict[str, Assertion] = {}
        self.marked: set[str] = set()  # the goals for which the check has reached a mark
        self._goals: dict[str, bool] = {}  # the goals that were examined separately, and whether they hold

    @property
    def assertions(self) -> tuple[Assertion, ...]:
        """The assertions, in the order in which they were first checked."""
        return tuple(self._assertions.values())

    @property
    def failed_goals(self) -> set[str]:
        """The goals of which an assertion does not hold."""
        return {goal for goal, fulfilled in self._goals.items() if not fulfilled}

    @property
    def kept_goals(self) -> set[str]:
        """The goals that are fulfilled even if the check does not reach its end."""
        return self.marked - self.failed_goals

    @property
    def fulfilled_goals(self) -> set[str]:
        """The goals that are fulfilled if the check reaches its end."""
        return (self.marked | self._goals.keys()) - self.failed_goals

    def goal_ended(self, goal: str, *, fulfilled: bool) -> None:
        """Record whether the assertions of `goal` hold; a goal that failed once stays so."""
        self._goals[goal] = fulfilled and self._goals.get(goal, True)

    def passes(self, assertion: str) -> None:
        """Record that `assertion` holds; it may still fail when it is checked again."""
        self._assertions.setdefault(assertion, Assertion(assertion, holds=True))

    def fails(self, assertion: str, *, expected: str = "", actual: str = "", hint: str = "") -> NoReturn:
        """Record that `assertion` does not hold, and end the check or the goal by raising AssertionFailed.

        If it fails several times, which is possible inside goals, the report shows the first time.
        """
        known = self._assertions.pop(assertion, None)
        failed = Assertion(assertion, False, self.asked(), expected, actual, hint)
        self._assertions[assertion] = known if known and not known.holds else failed
        raise AssertionFailed(assertion)
