"""Doing something at a rate that does not drift."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

CATCH_UP = 0.25  # s; a machine that was busy for so long has to make up for it at once, for longer not at all


class Metronome:
    """Calls `tick` `rate` times a second on a thread of its own, until stop().

    Each tick is due at a time of its own from the start on, so that a late one does not delay those after it.
    Those that are late by more than `CATCH_UP` s are left out, and counted in `skipped`.
    """

    def __init__(self, rate: float, tick: Callable[[], None], failed: Callable[[Exception], None]) -> None:
        self.rate = rate
        self.skipped = 0
        self._tick = tick
        self._failed = failed
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True, name="metronome")
        self._thread.start()

    def stop(self) -> None:
        """Return when no further tick will come."""
        self._stop.set()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _run(self) -> None:
        start, number = time.monotonic(), 0
        try:
            while not self._stop.wait(max(0.0, start + number / self.rate - time.monotonic())):
                self._tick()
                missed = max(0, int((time.monotonic() - start - CATCH_UP) * self.rate) - number)
                self.skipped += missed
                number += missed + 1
        except Exception as error:  # noqa: BLE001 - a thread must not die in silence
            self._failed(error)
