"""The recent values of a field, few enough to be sent, whatever the rate."""

from __future__ import annotations

import math
import threading
from collections import deque

SPAN = 20.0  # s
STEP = 0.1  # s

Point = tuple[float, float]


class Curve:
    """Values by time (s); of each step the first, smallest, largest and last are kept."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._steps: deque[tuple[int, list[Point]]] = deque()
        self.count = 0
        self.left_out = 0

    def add(self, at: float, value: float) -> None:
        """Take a value in; one that is NaN or infinite is only counted."""
        with self._turn:
            self.count += 1
            if not math.isfinite(value):
                self.left_out += 1
                return
            step = int(at / STEP)
            if not self._steps or self._steps[-1][0] != step:
                self._steps.append((step, [(at, value)] * 4))
            else:
                _take((at, value), self._steps[-1][1])

    def points(self, now: float) -> list[Point]:
        """Return what is kept of the last 20 s, oldest first."""
        with self._turn:
            while self._steps and self._steps[0][0] < int((now - SPAN) / STEP):
                self._steps.popleft()
            return [point for _, kept in self._steps for point in sorted(set(kept))]


def _take(point: Point, kept: list[Point]) -> None:
    """Put a point into [first, smallest, largest, last] of its step."""
    if point[1] < kept[1][1]:
        kept[1] = point
    if point[1] > kept[2][1]:
        kept[2] = point
    kept[3] = point
