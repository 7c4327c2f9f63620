"""Statistics of a topic with bounded memory: the rate of its messages, and the recent values of a field."""

from __future__ import annotations

import math
import threading
from collections import deque
from itertools import pairwise

from course_pkg.ros.topic.reports import Figures

WINDOW = 3.0  # length in s of the time over which a rate is measured
FEW = 5  # number of messages that are used even if they are older than WINDOW
MOST = 5000  # maximum number of messages for one rate
SILENCE = 3.0  # number of mean gaps; after this time without a message, no statistics are returned
SPAN = 20.0  # length of a series in s
STEP = 0.1  # length of a step in s; at most four values are stored for each step

Point = tuple[float, float]


class RateStatistics:
    """Measures the rate of a repeated event; several threads may share this object."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._times: deque[float] = deque(maxlen=MOST)

    def beat(self, at: float) -> None:
        """Record that the event has happened at `at` (s of time.monotonic())."""
        with self._lock:
            self._times.append(at)

    def figures(self, now: float) -> Figures:
        """Return the statistics of the last 3 s, or of the last 5 events.

        The result is empty if no more events arrive.
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
        """Return the stored points of the last 20 s, the oldest first."""
        with self._lock:
            while self._steps and self._steps[0][0] < int((now - SPAN) / STEP):
                self._steps.popleft()
            return [point for _, stored in self._steps for point in sorted(set(stored))]


def _merge(point: Point, stored: list[Point]) -> None:
    """Update [first, smallest, largest, last] of a step with a new point."""
    if point[1] < stored[1][1]:
        stored[1] = point
    if point[1] > stored[2][1]:
        stored[2] = point
    stored[3] = point
