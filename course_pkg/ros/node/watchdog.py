"""One thread that acts when deadlines pass: the deadline of a call costs microseconds and no other thread."""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Callable

LINGER = 5.0  # s between checks whether any action is still armed
REPEAT = 0.02  # s until an action is repeated


class Watchdog:
    """Calls an action once its deadline has passed, and again every 20 ms, until it is disarmed.

    It is repeated because a socket cannot be shut down before it is created. The thread runs while an action
    is armed, and some seconds longer, since calls often follow each other.
    """

    def __init__(self) -> None:
        self._armed: dict[int, tuple[float, Callable[[], None]]] = {}
        self._numbers = itertools.count()
        self._changed = threading.Condition()
        self._wake = 0.0
        self._thread: threading.Thread | None = None

    def arm(self, deadline: float, action: Callable[[], None]) -> int:
        """Call `action` from `deadline` (of time.monotonic()) on; return the number that disarm() takes."""
        number = next(self._numbers)
        self._armed[number] = (deadline, action)
        if self._thread is None or deadline < self._wake:
            self._wake_thread()
        return number

    def disarm(self, number: int) -> None:
        """Do not call the action any more; one that is being called now may still finish."""
        self._armed.pop(number, None)

    def _wake_thread(self) -> None:
        with self._changed:
            if self._thread is None:
                self._thread = threading.Thread(target=self._watch, name="call-watchdog", daemon=True)
                self._thread.start()
            self._changed.notify()

    def _watch(self) -> None:
        while self._armed or not self._may_end():
            now = time.monotonic()
            due = [action for deadline, action in list(self._armed.values()) if deadline <= now]
            for action in due:
                action()
            with self._changed:
                self._wake = (
                    math.inf
                )  # an action armed from here on may be missed below, so arm() wakes this thread
                earliest = min((deadline for deadline, _ in list(self._armed.values())), default=now)
                self._wake = max(earliest, now + REPEAT) if due else min(earliest, now + LINGER)
                self._changed.wait(max(self._wake - time.monotonic(), 0))

    def _may_end(self) -> bool:
        """Return whether this thread may end; from then on arm() starts another one."""
        with self._changed:
            self._thread = None
            if self._armed:  # by a thread that still saw this one
                self._thread = threading.current_thread()
            return self._thread is None
