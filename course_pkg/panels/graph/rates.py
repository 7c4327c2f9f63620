"""How often messages go over a connection, from counts at a few times, as a number that stands still."""

from __future__ import annotations

from collections import deque
from math import floor, log10, sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from course_pkg.graph.activity import Activity, Carried

LONG, SHORT = 30.0, 3.9  # s: how far back a steady rate is measured, and in how short a time a change is seen
LEAST = 1.5  # s: less than that tells nothing
LATE = 0.05  # s by which a count may be older than it seems: its node was busy when it was asked

Key = tuple[str, str, str, int]


class Meter:
    """The rate of one connection."""

    def __init__(self) -> None:
        self._counts: deque[tuple[float, int]] = deque()
        self._shown: float | None = None

    def read(self, at: float, messages: int) -> None:
        """Take in a count at a time (s)."""
        if self._counts and messages < self._counts[-1][1]:
            self._counts.clear()  # another connection of the same name: its publisher began anew
        self._counts.append((at, messages))
        while at - self._counts[0][0] > LONG:
            self._counts.popleft()
        self._forget_other_times()
        self._settle()

    @property
    def rate(self) -> float | None:
        """Messages per second, rounded as far as the counts can tell; None as long as they do not."""
        return self._shown

    def _forget_other_times(self) -> None:
        """Keep only the latest counts, if they do not fit to what went before."""
        at, messages = self._counts[-1]
        lately = [each for each in self._counts if at - each[0] >= SHORT]
        if len(lately) < 2:
            return
        (first, sent), (middle, until) = lately[0], lately[-1]
        expected = (until - sent) / (middle - first) * (at - middle)
        fell_silent = messages == until and expected >= 3
        if fell_silent or abs(messages - until - expected) > 2 + 3 * sqrt(expected):
            self._counts = deque(each for each in self._counts if each[0] >= middle)

    def _settle(self) -> None:
        (since, before), (at, messages) = self._counts[0], self._counts[-1]
        if at - since < LEAST:
            return
        rate = (messages - before) / (at - since)
        doubt = (1 + LATE * rate) / (at - since)
        stands = self._shown is not None and abs(self._shown - rate) <= doubt + 0.01 * rate
        if not stands or bool(rate) != bool(self._shown):
            self._shown = plainest(rate, doubt)


def plainest(rate: float, doubt: float) -> float:
    """Return the number with the fewest digits that is no further from the rate than `doubt`."""
    if rate <= 0:
        return 0.0
    for digits in range(3):
        rounded = round(rate, digits - floor(log10(rate)))
        if abs(rounded - rate) <= doubt:
            return rounded
    return rounded


def words(rate: float) -> str:
    """Return a rate to be read: "10 Hz"."""
    if 0 < rate < 0.1:
        return "< 0.1 Hz"
    return f"{rate:.3g} Hz" if rate < 999.5 else f"{rate / 1000:.3g} kHz"


class Rates:
    """The rates of all connections of a graph."""

    def __init__(self) -> None:
        self._meters: dict[Key, Meter] = {}

    def read(self, activity: Activity) -> None:
        """Take in all counts of one time; forget connections that are no more."""
        meters = {_key(each): self._meters.get(_key(each)) or Meter() for each in activity.carried}
        for each in activity.carried:
            meters[_key(each)].read(activity.at, each.messages)
        self._meters = meters

    def of(self, carried: Carried) -> float | None:
        """Return the rate of a connection (Hz)."""
        meter = self._meters.get(_key(carried))
        return meter.rate if meter else None


def _key(carried: Carried) -> Key:
    return (carried.topic, carried.publisher, carried.subscriber, carried.connection)
