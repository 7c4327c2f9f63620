"""How far grading is, and how long it will take: numbers, never names."""

from __future__ import annotations

import sys
import time
from typing import TextIO

STEP = 10.0  # s between lines, where nobody watches a terminal


class Progress:
    """Writes one line that changes, on a terminal; elsewhere a line now and then."""

    def __init__(self, total: int, stream: TextIO | None = None) -> None:
        self._total = total
        self._stream = stream or sys.stderr
        self._kept = self._done = 0
        self._began = self._said = time.monotonic()

    def begin(self, kept: int) -> None:
        """Say how many are done from an earlier run."""
        self._kept = self._done = kept
        self._began = time.monotonic()
        if kept:
            self._stream.write(f"{kept} of {self._total} notebooks are graded from an earlier run.\n")

    def more(self, count: int) -> None:
        """Count `count` more."""
        self._done += count
        now, live = time.monotonic(), self._stream.isatty()
        if live or now - self._said >= STEP:
            self._said = now
            end = "\r" if live else "\n"
            self._stream.write(f"{self._line(now):<60}{end}")
            self._stream.flush()

    def end(self) -> None:
        """Leave the line."""
        if self._stream.isatty() and self._done > self._kept:
            self._stream.write("\n")

    def _line(self, now: float) -> str:
        left = self._total - self._done
        words = f"graded {self._done} of {self._total}"
        if not left or self._done == self._kept:
            return words
        seconds = (now - self._began) / (self._done - self._kept) * left
        return (
            f"{words}, about {seconds:.0f} s left"
            if seconds < 90
            else f"{words}, about {seconds / 60:.0f} min left"
        )
