"""The customers that a camera sees at a counter, and functions that wait for a customer.

This module does not need ROS.

A Watch receives messages with the customers' numbers. An Eye receives frames, which are pictures of the
counter.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeAlias, TypeVar

from course_pkg.errors import CameraSilent

if TYPE_CHECKING:
    import genpy

# A waiting thread checks whether the camera is silent, at least once in this time (s).
POLL = 0.25
# The state of the counter is unknown if an Eye receives no valid frame for this time in s.
FRAME_TIMEOUT = 1.0

Time: TypeAlias = "float | genpy.Time"  # a time on the clock that a Watch uses
Frame = TypeVar("Frame")


class CameraMessage(Protocol):
    """A message with the numbers of the customers at the counter, such as std_msgs/Int32MultiArray."""

    data: Sequence[int]


class Customer(NamedTuple):
    """A customer at the counter: the number, and the time of the first message that contained this number."""

    number: int
    arrived: Time


class Watch:
    """Stores the customers at the counter, from the messages of a camera.

    Acquire the condition `changed` before you read the customers or wait for a change.
    """

    def __init__(self, now: Callable[[], Time] = time.time) -> None:
        self.changed = threading.Condition()
        self._now = now
        self._there: tuple[Customer, ...] = ()
        self._last = -float("inf")  # The camera's last message arrived at this value of time.monotonic().

    @property
    def silent_for(self) -> float:
        """The time since the camera's last message in s, or infinity before the first message."""
        return time.monotonic() - self._last

    @property
    def count(self) -> int:
        """The number of customers at the counter."""
        return len(self._there)

    def hear(self, message: CameraMessage) -> None:
        """Process a message of the camera; this method is the callback of a subscriber."""
        self.see(message.data)

    def see(self, numbers: Sequence[int]) -> list[Customer]:
        """Set the customers at the counter, notify the waiting threads, and return the new customers."""
        with self.changed:
            self._last = time.monotonic()
            known = {customer.number: customer for customer in self._there}
            came = [Customer(number, self._now()) for number in numbers if number not in known]
            if came or len(known) != len(numbers):
                fresh = {customer.number: customer for customer in came}
                self._there = tuple(known.get(number) or fresh[number] for number in numbers)
                self.changed.notify_all()
            return came

    def next(self, after: int = 0) -> Customer | None:
        """Return the customer with the lowest number above `after`, or None if there is no such customer.

        This method does not wait.
        """
        return min((customer for customer in self._there if customer.number > after), default=None)

    def wait(self, after: int, patience: float, silence: float) -> Customer | None:
        """Wait for a customer with a number above `after`; return this customer.

        If no such customer comes within the time `patience` (s), return None.

        Raises CameraSilent if no message has arrived for the time `silence` (s).
        """
        deadline = time.monotonic() + patience
        with self.changed:
            while self.silent_for <= silence:
                customer = self.next(after)
                rest = deadline - time.monotonic()
                if customer or rest <= 0:
                    return customer
                self.changed.wait(min(rest, POLL))
        raise CameraSilent(f"The camera has sent no message for {silence:g} s. Check that its node runs.")


class Eye(Generic[Frame]):
    """Reads frames, and stores whether the newest valid frame shows a customer.

    `sees` returns whether a frame shows a customer, and raises ValueError for an invalid frame. A valid frame
    wakes the threads that wait for the condition `changed`.
    """

    def __init__(self, sees: Callable[[Frame], bool]) -> None:
        self.changed = threading.Condition()
        self._sees = sees
        self._seen = False
        self._last = -float("inf")  # The newest valid frame arrived at this value of time.monotonic().

    def hear(self, frame: Frame) -> None:
        """Process a frame, but ignore an invalid frame; this method is the callback of a subscriber."""
        try:
            seen = self._sees(frame)
        except ValueError:
            return
        with self.changed:
            self._seen, self._last = seen, time.monotonic()
            self.changed.notify_all()

    def look(self) -> bool | None:
        """Return whether a customer is at the counter, or None without a valid frame in the last second."""
        return self._seen if time.monotonic() - self._last <= FRAME_TIMEOUT else None


def await_customer(eye: Eye[Frame], patience: float) -> bool:
    """Return True as soon as a customer is at the counter, or False if no customer comes in time.

    The maximum waiting time is `patience` (s).

    Raises CameraSilent after the waiting time if no valid frame has arrived in the last second.
    """
    with eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent(f"no message about the camera's frames has arrived for {FRAME_TIMEOUT:g} s")
    return bool(found)
