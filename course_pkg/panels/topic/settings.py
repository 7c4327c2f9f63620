"""The settings of a topic panel's publisher: texts from the page, and their values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from course_pkg.errors import FieldError

RATE, QUEUE = "@rate", "@queue"  # No field has these names, because a field's name cannot contain "@".
SLOWEST, FASTEST = 0.1, 100.0  # The rates are in messages per second.
LONGEST = 10_000  # The student can set the queue size of the publisher to at most this many messages.


@dataclass(frozen=True)
class Settings:
    """The publisher's settings as texts: the rate, the queue size, and whether the topic is latched.

    `path` is the field that the panel plots, or "" for none.
    """

    rate: str = "10"
    queue: str = "10"
    latch: bool = False
    path: str = ""

    @classmethod
    def of_page(cls, given: Mapping[str, str | bool]) -> Settings:
        """Return the settings from a message of the page."""
        rate, queue, path = (str(given.get(name, "")) for name in ("rate", "queue", "path"))
        return cls(rate, queue, bool(given.get("latch")), path)

    @property
    def hertz(self) -> float:
        """The rate in messages per second.

        Raises FieldError if the rate is not a number or is out of range.
        """
        return _number(RATE, self.rate, SLOWEST, FASTEST, f"a rate from {SLOWEST:g} to {FASTEST:g} Hz")

    @property
    def size(self) -> int:
        """The queue size in messages; 0 means that the queue has no limit.

        Raises FieldError if the queue size is not valid.
        """
        allowed = f"a whole number from 0 (no limit) to {LONGEST}"
        size = _number(QUEUE, self.queue, 0, LONGEST, allowed)
        if size != int(size):
            raise _wrong(QUEUE, self.queue, allowed)
        return int(size)


def _number(field: str, text: str, low: float, high: float, allowed: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = low - 1
    if not low <= value <= high:
        raise _wrong(field, text, allowed)
    return value


def _wrong(field: str, text: str, allowed: str) -> FieldError:
    return FieldError(field, text, allowed, f"{text!r} is not valid here")
