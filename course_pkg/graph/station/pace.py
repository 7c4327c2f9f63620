"""How often something happens, and how evenly."""

from __future__ import annotations

import math
import threading
from collections import deque
from itertools import pairwise

WINDOW = 3.0  # s over which one looks back
FEW = 5  # of what is rarer, the last so many
MOST = 5000  # and of what is more frequent, no more than these
SILENCE = 3.0  # times the mean gap, after which it has stopped


class Pace:
    """The times of something that happens again and again; threads may share it."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._times: deque[float] = deque(maxlen=MOST)

    def beat(self, at: float) -> None:
        """Take note that it has happened at `at` (s of time.monotonic())."""
        with self._turn:
            self._times.append(at)

    def figures(self, now: float) -> dict[str, float]:
        """Return rate (1/s), jitter and longest gap (s), and of how many gaps; empty if it does not go on."""
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
        with self._turn:
            while len(self._times) > FEW and self._times[0] < now - WINDOW:
                self._times.popleft()
            return list(self._times)
