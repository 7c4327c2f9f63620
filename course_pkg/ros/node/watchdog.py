"""One thread checks the deadlines of all calls."""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Callable

LINGER = 5.0  # The thread checks the armed actions again after at most this time in s.
REPEAT = 0.02  # An armed action runs again after this time in s.


class Watchdog:
    """Runs an action after its deadline, and again every 20 ms, until the action is disarmed.

    An action shuts down a socket, which may not exist yet when the action runs for the first time. The thread
    ends some seconds after the last action was disarmed.
    """

    def __init__(self) -> None:
        self._armed: dict[int, tuple[float, Callable[[], None]]] = {}
        self._numbers = itertools.count()
        self._changed = threading.Condition()
        self._wake = 0.0
        self._thread: threading.Thread | None = None

    def arm(self, deadline: float, action: Callable[[], None]) -> int:
        """Run the action after its deadline (time.monotonic()); return the argument for disarm()."""
        number = next(self._numbers)
        self._armed[number] = (deadline, action)
        if self._thread is None or deadline < self._wake:
            self._wake_thread()
        return number

    def disarm(self, number: int) -> None:
        """Remove the action; a run of the action that has already started is not interrupted."""
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
                # Another thread may call arm() while the next lines run. Because `_wake` is infinite at
                # first, each call of arm() wakes up this thread.
                self._wake = math.inf
                earliest = min((deadline for deadline, _ in list(self._armed.values())), default=now)
                self._wake = max(earliest, now + REPEAT) if due else min(earliest, now + LINGER)
                self._changed.wait(max(self._wake - time.monotonic(), 0))

    def _may_end(self) -> bool:
        """Return whether this thread may end. If it ends, the next arm() starts a new thread."""
        with self._changed:
            self._thread = None
            # If another thread has armed an action in the meantime, this thread continues.
            if self._armed:
                self._thread = threading.current_thread()
            return self._thread is None
