"""Time limits: a deadline, a wait for a condition, and a limit after which running code is interrupted."""

from __future__ import annotations

import math
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

Value = TypeVar("Value")
INTERVAL = 0.01  # time in s between two evaluations of a condition
MOST = 4.0  # maximum factor by which a limit grows on a busy machine


class Deadline:
    """A point in time, `seconds` from now on the monotonic clock.

    If `seconds` is None, the deadline never passes.
    """

    def __init__(self, seconds: float | None) -> None:
        self.seconds = seconds  # the seconds that were given
        self._end = float("inf") if seconds is None else time.monotonic() + seconds

    @property
    def left(self) -> float:
        """The seconds that are left, at least 0, or infinity if the deadline never passes."""
        return max(self._end - time.monotonic(), 0.0)

    @property
    def milliseconds(self) -> int | None:
        """The milliseconds that are left, rounded up, for select.poll. None if the deadline never passes."""
        return None if self.seconds is None else math.ceil(self.left * 1000)

    @property
    def passed(self) -> bool:
        """Whether no time is left."""
        return time.monotonic() >= self._end


def wait_until(
    condition: Callable[[], Value],
    timeout: float,
    interval: float = INTERVAL,
    stopped: threading.Event | None = None,
) -> Value:
    """Return the first true value of `condition`, or its last value when `timeout` s have passed.

    The condition is evaluated immediately, then every `interval` s, and once more after the deadline. A
    thread that could not run for a long time therefore also returns the current value. If the event `stopped`
    is set, the wait ends early.
    """
    deadline = Deadline(timeout)
    while True:
        last = deadline.passed
        value = condition()
        if value or last:
            return value
        pause = min(interval, deadline.left)
        if stopped is None:
            time.sleep(pause)
        elif stopped.wait(pause):
            return condition()


def at_this_load(seconds: float) -> float:
    """Return a time limit in s for work that takes at most `seconds` s on an idle machine.

    The limit grows with the load average of the last minute per core, up to MOST times `seconds`. Without a
    longer limit, a program that waits for the processor would look like a program that never ends.
    """
    load: float = os.getloadavg()[0] / (os.cpu_count() or 1)
    return seconds * min(max(load, 1.0), MOST)


@contextmanager
def interrupt_after(seconds: float, error: type[BaseException], repeat: float = 0.0) -> Iterator[None]:
    """Raise `error` in the block when the block has run for `seconds` s, and again every `repeat` s.

    If `repeat` is 0, `error` is raised only once. Use `repeat` for code that may catch the first error. This
    function uses an alarm signal (SIGALRM). The block therefore has to run in the main thread, and such
    blocks may not be nested. Raises ValueError in another thread.
    """

    def alarm(*_: object) -> None:
        raise error

    before = signal.signal(signal.SIGALRM, alarm)
    signal.setitimer(signal.ITIMER_REAL, seconds, repeat)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
