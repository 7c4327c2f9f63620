"""What a program knows about a counter from a camera, and waiting for a customer. It needs no ROS.

A Watch gets the numbers of the customers from its camera, an Eye gets frames.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeAlias, TypeVar

from course_pkg.errors import CameraSilent

if TYPE_CHECKING:
    import genpy

POLL = 0.25  # s between checks whether the camera is still there
FRAME_TIMEOUT = 1.0  # s without a good frame, after which an Eye does not know who is there

Time: TypeAlias = "float | genpy.Time"  # of a Watch's clock
Frame = TypeVar("Frame")


class CameraMessage(Protocol):
    """A message with the numbers of the customers at the counter, such as std_msgs/Int32MultiArray."""

    data: Sequence[int]


class Customer(NamedTuple):
    """A customer at the counter: a number, and when they were first seen, by the clock of the Watch."""

    number: int
    arrived: Time


class Watch:
    """The customers at the counter. Hold the condition `changed` to read them or to wait for a change."""

    def __init__(self, now: Callable[[], Time] = time.time) -> None:
        self.changed = threading.Condition()
        self._now = now
        self._there: tuple[Customer, ...] = ()
        self._last = -float("inf")  # time of the camera's last message, in s of time.monotonic()

    @property
    def silent_for(self) -> float:
        """Time since the camera's last message, in s; infinity before the first one."""
        return time.monotonic() - self._last

    @property
    def count(self) -> int:
        """How many customers are at the counter."""
        return len(self._there)

    def hear(self, message: CameraMessage) -> None:
        """Process a message of the camera."""
        self.see(message.data)

    def see(self, numbers: Sequence[int]) -> list[Customer]:
        """Set the customers at the counter, wake the waiting threads, and return the new customers."""
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
        """Return the customer with the lowest number above `after`, or None, without waiting."""
        return min((customer for customer in self._there if customer.number > after), default=None)

    def wait(self, after: int, patience: float, silence: float) -> Customer | None:
        """Return the next customer as soon as there is one; None after `patience` s.

        Raises CameraSilent if the camera has sent no message for `silence` s.
        """
        deadline = time.monotonic() + patience
        with self.changed:
            while self.silent_for <= silence:
                customer = self.next(after)
                rest = deadline - time.monotonic()
                if customer or rest <= 0:
                    return customer
                self.changed.wait(min(rest, POLL))
        raise CameraSilent(f"No message from the camera for {silence:g} s.")


class Eye(Generic[Frame]):
    """What the newest good frame shows; `changed` is notified of each good frame."""

    def __init__(self, sees: Callable[[Frame], bool]) -> None:
        self.changed = threading.Condition()
        self._sees = sees
        self._seen = False
        self._last = -float("inf")  # time of the newest good frame, in s of time.monotonic()

    def hear(self, frame: Frame) -> None:
        """Process a frame; a malformed frame is ignored."""
        try:
            seen = self._sees(frame)
        except ValueError:
            return
        with self.changed:
            self._seen, self._last = seen, time.monotonic()
            self.changed.notify_all()

    def look(self) -> bool | None:
        """Return whether a customer is there; None if no good frame came in the last second."""
        return self._seen if time.monotonic() - self._last <= FRAME_TIMEOUT else None


def await_customer(eye: Eye[Frame], patience: float) -> bool:
    """Return whether a customer is there, as soon as one is, and after at most `patience` s.

    Raises CameraSilent if no good frame came in the second before the end.
    """
    with eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent(f"no message about the camera's frames has arrived for {FRAME_TIMEOUT:g} s")
    return bool(found)
