"""One thread watches the deadlines of all calls, so a call needs no extra thread for its deadline."""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Callable

LINGER = 5.0  # s between checks if any action is still armed
REPEAT = 0.02  # s until an action is repeated


class Watchdog:
    """Runs an action after its deadline has passed, and again every 20 ms, until the action is disarmed.

    The action is repeated because a socket cannot be shut down before it is created. The thread runs while
    an action is armed. It runs some seconds longer because the next call often follows soon.
    """

    def __init__(self) -> None:
        self._armed: dict[int, tuple[float, Callable[[], None]]] = {}
        self._numbers = itertools.count()
        self._changed = threading.Condition()
        self._wake = 0.0
        self._thread: threading.Thread | None = None

    def arm(self, deadline: float, action: Callable[[], None]) -> int:
        """Run `action` after `deadline` (s of time.monotonic()); return the number that disarm() needs."""
        number = next(self._numbers)
        self._armed[number] = (deadline, action)
        if self._thread is None or deadline < self._wake:
            self._wake_thread()
        return number

    def disarm(self, number: int) -> None:
        """Stop running the action; if it is running at this moment, it still finishes."""
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
                # The next lines may miss an action that is armed now; with inf, arm() wakes this thread.
                self._wake = math.inf
                earliest = min((deadline for deadline, _ in list(self._armed.values())), default=now)
                self._wake = max(earliest, now + REPEAT) if due else min(earliest, now + LINGER)
                self._changed.wait(max(self._wake - time.monotonic(), 0))

    def _may_end(self) -> bool:
        """Return whether this thread may end; if it may, the next arm() starts a new thread."""
        with self._changed:
            self._thread = None
            if self._armed:  # Another thread armed an action while this thread was still registered.
                self._thread = threading.current_thread()
            return self._thread is None
