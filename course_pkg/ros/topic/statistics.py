"""Compute the rate of a topic's messages, and store recent values of a field, in limited memory."""

from __future__ import annotations

import math
import threading
from collections import deque
from itertools import pairwise

from course_pkg.ros.topic.reports import Figures

WINDOW = 3.0  # A rate is measured over this time in s.
FEW = 5  # At least this number of messages is used, even if some of them are older than WINDOW.
MOST = 5000  # A rate is computed from at most this number of messages.
# There are no statistics if the last message is older than 2 s and also older than this number of mean gaps.
SILENCE = 3.0
SPAN = 20.0  # A series contains only values that are at most this old (s).
STEP = 0.1  # At most four values are stored for each time step of this length in s.

Point = tuple[float, float]


class RateStatistics:
    """Measures the rate of a repeated event; several threads may use this object."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._times: deque[float] = deque(maxlen=MOST)

    def beat(self, at: float) -> None:
        """Record an event at the time `at`, a value of time.monotonic()."""
        with self._lock:
            self._times.append(at)

    def figures(self, now: float) -> Figures:
        """Return the statistics of the events in the last 3 s, but of at least the last 5 events.

        The result is empty if the last event is older than 2 s and also older than three mean gaps.
        """
        times = self._latest(now)
        if len(times) < 2:
            return {}
        gaps = [later - earlier for earlier, later in pairwise(times)]
        mean = (times[-1] - times[0]) / len(gaps)
        if now - times[-1] > max(2.0, SILENCE * mean) or mean <= 0:
            return {}
        jitter = math.sqrt(sum((gap - mean) ** 2 for gap in gaps) / len(gaps))
        return {"rate": 1 / mean, "jitter": jitter, "longest": max(gaps), "gaps": len(gaps)}

    def _latest(self, now: float) -> list[float]:
        with self._lock:
            while len(self._times) > FEW and self._times[0] < now - WINDOW:
                self._times.popleft()
            return list(self._times)


class DownsampledSeries:
    """Stores values with their times (s).

    For each step of 0.1 s, only the first, smallest, largest and last value are stored.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._steps: deque[tuple[int, list[Point]]] = deque()
        self.count = 0
        self.left_out = 0

    def add(self, at: float, value: float) -> None:
        """Add a value; a value that is NaN or infinite is only counted."""
        with self._lock:
            self.count += 1
            if not math.isfinite(value):
                self.left_out += 1
                return
            step = int(at / STEP)
            if not self._steps or self._steps[-1][0] != step:
                self._steps.append((step, [(at, value)] * 4))
            else:
                _merge((at, value), self._steps[-1][1])

    def points(self, now: float) -> list[Point]:
        """Return the stored points of the last 20 s, the oldest point first."""
        with self._lock:
            while self._steps and self._steps[0][0] < int((now - SPAN) / STEP):
                self._steps.popleft()
            return [point for _, stored in self._steps for point in sorted(set(stored))]


def _merge(point: Point, stored: list[Point]) -> None:
    """Update the values [first, smallest, largest, last] of a time step with a new point."""
    if point[1] < stored[1][1]:
        stored[1] = point
    if point[1] > stored[2][1]:
        stored[2] = point
    stored[3] = point
