"""One thread that acts when deadlines pass, so that a bound on a call costs microseconds and not a thread."""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Callable

LINGER = 5.0  # s between looks whether anything is still armed
AGAIN = 0.02  # s until an action that has not helped is repeated


class Watchdog:
    """Calls an action once its deadline has passed, and again every 20 ms, until it is disarmed.

    Repeated, because a socket cannot be shut down before it is made, or not yet. Its thread is there
    while something is armed, and some seconds longer: calls come in rows.
    """

    def __init__(self) -> None:
        self._armed: dict[int, tuple[float, Callable[[], None]]] = {}
        self._numbers = itertools.count()
        self._changed = threading.Condition()
        self._wake = 0.0
        self._thread: threading.Thread | None = None

    def arm(self, deadline: float, action: Callable[[], None]) -> int:
        """Have `action` called from `deadline` (of time.monotonic()) on; return what disarm() needs."""
        number = next(self._numbers)
        self._armed[number] = (deadline, action)
        if self._thread is None or deadline < self._wake:
            self._hasten()
        return number

    def disarm(self, number: int) -> None:
        """Have the action not called any more; one that is being called now may still finish."""
        self._armed.pop(number, None)

    def _hasten(self) -> None:
        with self._changed:
            if self._thread is None:
                self._thread = threading.Thread(target=self._watch, name="call-watchdog", daemon=True)
                self._thread.start()
            self._changed.notify()

    def _watch(self) -> None:
        while self._armed or not self._ends():
            now = time.monotonic()
            due = [action for deadline, action in list(self._armed.values()) if deadline <= now]
            for action in due:
                action()
            with self._changed:
                self._wake = math.inf  # who arms from here on may not have been seen, and knocks
                earliest = min((deadline for deadline, _ in list(self._armed.values())), default=now)
                self._wake = max(earliest, now + AGAIN) if due else min(earliest, now + LINGER)
                self._changed.wait(max(self._wake - time.monotonic(), 0))

    def _ends(self) -> bool:
        """Say whether this thread may end; it first says that it has, so that arm() makes another."""
        with self._changed:
            self._thread = None
            if self._armed:  # by somebody who still saw this thread
                self._thread = threading.current_thread()
            return self._thread is None
