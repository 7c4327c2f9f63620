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

# A condition is a wrong value, a pattern made by `matches`, or a function that returns whether the actual
# value matches. If a function raises an exception, for example because the value has another type, the value
# does not match.
Condition: TypeAlias = "Plain | bytes | re.Pattern[str] | Callable[[Any], object]"
ANYTHING: Condition = re.compile("")  # This condition matches every value.
# Hints are either one hint for every wrong value, or a list of pairs (condition, hint). In a list, the first
# condition that matches selects the hint.
Hints: TypeAlias = "str | Sequence[tuple[Condition, str]]"


class AssertionFailed(Exception):
    """An assertion does not hold, so the check or the current goal ends."""


def matches(pattern: str) -> re.Pattern[str]:
    """Return a condition for values with a text that matches the pattern `pattern`; case is ignored."""
    return re.compile(pattern, re.IGNORECASE | re.DOTALL)


def same(expected: Json, actual: Json, near: float = 0.0) -> bool:
    """Return whether two values of plain data are equal.

    Two numbers count as equal if their absolute or relative difference is at most `near`.

    In contrast to `==`, True and 1 are different.
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
        # An integer that is too large for a float equals only the same integer.
        with suppress(OverflowError):
            return expected == actual or math.isclose(expected, actual, rel_tol=near, abs_tol=near)
        return False
    return type(expected) is type(actual) and bool(expected == actual)


def first_unlike(expected: Iterable[Json], actual: Iterable[Json], near: float) -> tuple[Json, Json]:
    """Return the first pair of unequal items of two lists, or ({}, {}) if there is none.

    A report shows only the returned pair, not all items.
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
        # The student's value can have a type that the function does not expect.
        except (TypeError, ValueError, LookupError, AttributeError):
            return False
    return same(plain(condition), actual, near)


class Results:
    """The assertions that were checked, and the last call that the check made."""

    def __init__(self) -> None:
        # This function returns the check's last call as text. The function is called only if a check fails.
        # The function is called only if a check fails.
        self.asked: Callable[[], str] = str
        self._assertions: dict[str, Assertion] = {}
        self.marked: set[str] = set()  # The check has marked these goals as fulfilled.
        # The keys are the goals that `goal` blocks have examined; a value is true if the goal is fulfilled.
        self._goals: dict[str, bool] = {}

    @property
    def assertions(self) -> tuple[Assertion, ...]:
        """The assertions, in the order in which they were first checked."""
        return tuple(self._assertions.values())

    @property
    def failed_goals(self) -> set[str]:
        """The goals with a failed assertion."""
        return {goal for goal, fulfilled in self._goals.items() if not fulfilled}

    @property
    def kept_goals(self) -> set[str]:
        """The goals that count as fulfilled if the check ends early, before its last assertion."""
        return self.marked - self.failed_goals

    @property
    def fulfilled_goals(self) -> set[str]:
        """The goals that count as fulfilled if the check runs to its end."""
        return (self.marked | self._goals.keys()) - self.failed_goals

    def goal_ended(self, goal: str, *, fulfilled: bool) -> None:
        """Record whether the assertions of a goal hold; after one failure, the goal remains failed."""
        self._goals[goal] = fulfilled and self._goals.get(goal, True)

    def passes(self, assertion: str) -> None:
        """Record that `assertion` holds; it can fail in a later call."""
        self._assertions.setdefault(assertion, Assertion(assertion, holds=True))

    def fails(self, assertion: str, *, expected: str = "", actual: str = "", hint: str = "") -> NoReturn:
        """Record that `assertion` does not hold, and raise AssertionFailed to end the check or the goal.

        If an assertion fails several times, the report shows the first failure.
        """
        known = self._assertions.pop(assertion, None)
        failed = Assertion(assertion, False, self.asked(), expected, actual, hint)
        self._assertions[assertion] = known if known and not known.holds else failed
        raise AssertionFailed(assertion)
