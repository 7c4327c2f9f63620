"""How a message is published, as one types it: how often, with which queue, latched or not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from course_pkg.errors import FieldError

RATE, QUEUE = "@rate", "@queue"  # no field of a message can have these names
SLOWEST, FASTEST = 0.1, 100.0  # 1/s
LONGEST = 10_000  # messages in a queue


@dataclass(frozen=True)
class Settings:
    """The settings as texts, `path` being the number that is drawn ("" for none)."""

    rate: str = "10"
    queue: str = "10"
    latch: bool = False
    path: str = ""

    @classmethod
    def taken(cls, given: dict[str, Any]) -> Settings:
        """Return what a page has sent."""
        texts = {name: str(given.get(name, "")) for name in ("rate", "queue", "path")}
        return cls(latch=bool(given.get("latch")), **texts)

    @property
    def hertz(self) -> float:
        """The rate in 1/s. Raises FieldError."""
        return _number(RATE, self.rate, SLOWEST, FASTEST, f"a rate from {SLOWEST:g} to {FASTEST:g} Hz")

    @property
    def size(self) -> int:
        """The queue size in messages, 0 for no limit. Raises FieldError."""
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
    return FieldError(field, text, allowed, f"{text!r} cannot be taken here")
