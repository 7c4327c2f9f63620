"""What is known of a counter from what a camera says, and waiting for a change in it. No ROS."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from course_pkg.errors import CameraSilent

LOOK = 0.25  # s between looks at whether the camera is still there


class Customer(NamedTuple):
    """A customer at the counter: a number, and when they were first seen, by the clock of the Watch."""

    number: int
    arrived: Any


class Watch:
    """Knows who is at the counter. Hold `changed` to look at it, or to wait there until somebody comes."""

    def __init__(self, now: Callable[[], Any] = time.time) -> None:
        self.changed = threading.Condition()
        self._now = now
        self._there: tuple[Customer, ...] = ()
        self._told = -float("inf")  # when the camera last said anything, in s of time.monotonic()

    @property
    def silent_for(self) -> float:
        """How long the camera has said nothing, in s; infinity before its first word."""
        return time.monotonic() - self._told

    @property
    def count(self) -> int:
        """How many customers are at the counter."""
        return len(self._there)

    def hear(self, message: Any) -> None:  # noqa: ANN401 -- a class that genpy generates
        """Take in what the camera says: a message with the numbers of those who are there as its data."""
        self.see(message.data)

    def see(self, numbers: Sequence[int]) -> list[Customer]:
        """Take in who is at the counter now, wake up who waits, and return who has come."""
        with self.changed:
            self._told = time.monotonic()
            known = {customer.number: customer for customer in self._there}
            came = [Customer(number, self._now()) for number in numbers if number not in known]
            if came or len(known) != len(numbers):
                fresh = {customer.number: customer for customer in came}
                self._there = tuple(known.get(number) or fresh[number] for number in numbers)
                self.changed.notify_all()
            return came

    def next(self, after: int = 0) -> Customer | None:
        """Return the customer at the counter with the lowest number above `after`, or None; at once."""
        return min((customer for customer in self._there if customer.number > after), default=None)

    def wait(self, after: int, patience: float, silence: float) -> Customer | None:
        """Return the next customer as soon as there is one; None after `patience` s.

        Raises CameraSilent once the camera has said nothing for `silence` s: then nobody can tell.
        """
        deadline = time.monotonic() + patience
        with self.changed:
            while self.silent_for <= silence:
                customer = self.next(after)
                rest = deadline - time.monotonic()
                if customer or rest <= 0:
                    return customer
                self.changed.wait(min(rest, LOOK))
        raise CameraSilent(f"The camera has said nothing for {silence:g} s.")
