"""The counter of a shop, and the times at which each customer comes and leaves.

This module does not need ROS.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from course_pkg.errors import FieldError

MOST = 1000  # One call adds at most this number of customers.
LONGEST = 3600.0  # A customer's delay and stay are at most this time in s.


@dataclass(frozen=True)
class Visit:
    """One visit: the customer's number, and the times in s at which the customer comes and leaves."""

    number: int
    comes: float
    goes: float


class Counter:
    """The current and the planned visits; `number` is the number of the next new customer."""

    def __init__(self, number: int = 1) -> None:
        self.number = number
        self._visits: list[Visit] = []

    def let_in(self, now: float, after: Sequence[float], stay: float) -> list[Visit]:
        """Plan a visit for each delay in `after`, and return the new visits.

        A delay is a time in s from the time `now` until a customer comes; `stay` is the length of each visit
        in s. Visits that earlier calls have planned for the future are removed. Raises FieldError, and
        changes no visits, if a time is invalid.
        """
        if len(after) > MOST:
            raise FieldError(
                "after", after, f"at most {MOST} customers", f"{len(after)} customers are too many"
            )
        for index, delay in enumerate(after):
            _require_seconds(f"after[{index}]", delay)
        _require_seconds("stay", stay)
        starts = sorted(now + delay for delay in after)
        visits = [Visit(number, start, start + stay) for number, start in enumerate(starts, self.number)]
        self.number += len(visits)
        self._visits = [visit for visit in self._visits if visit.comes <= now < visit.goes] + visits
        return visits

    def there(self, now: float) -> tuple[int, ...]:
        """Return the numbers of the customers at the counter, in the order in which they came."""
        return tuple(visit.number for visit in self._visits if visit.comes <= now < visit.goes)

    def next_change(self, now: float) -> float:
        """Return the time at which the next customer comes or leaves, or infinity if there is no visit."""
        times = (time for visit in self._visits for time in (visit.comes, visit.goes) if time > now)
        return min(times, default=math.inf)


def _require_seconds(field: str, value: float) -> None:
    if not 0.0 <= value <= LONGEST:  # The condition also refuses NaN.
        raise FieldError(
            field,
            value,
            f"a number of seconds from 0 to {LONGEST:g}",
            f"{value:g} s is not a valid waiting time",
        )
