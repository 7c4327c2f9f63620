"""Time limits: a deadline, a wait for a condition, and a limit that interrupts running code."""

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
MOST = 4.0  # On a busy machine, a time limit grows by at most this factor.


class Deadline:
    """A deadline on the monotonic clock, `seconds` s after this object is created.

    If `seconds` is None, the deadline never passes.
    """

    def __init__(self, seconds: float | None) -> None:
        self.seconds = seconds
        self._end = float("inf") if seconds is None else time.monotonic() + seconds

    @property
    def left(self) -> float:
        """The remaining seconds, at least 0, or infinity if the deadline never passes."""
        return max(self._end - time.monotonic(), 0.0)

    @property
    def milliseconds(self) -> int | None:
        """The remaining milliseconds for select.poll, rounded up, or None if the deadline never passes."""
        return None if self.seconds is None else math.ceil(self.left * 1000)

    @property
    def passed(self) -> bool:
        """Whether the deadline has passed."""
        return time.monotonic() >= self._end


def wait_until(
    condition: Callable[[], Value],
    timeout: float,
    interval: float = INTERVAL,
    stopped: threading.Event | None = None,
) -> Value:
    """Return the first true value of `condition`, or its last value after the time limit.

    The time limit is `timeout` (s).

    The condition is evaluated immediately, then with pauses of `interval` (s), and once more after the time
    limit. The event `stopped` ends the wait early.
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

    The limit grows with the load average of the last minute per core, up to `MOST` times `seconds`. With a
    fixed limit, a slow program that waits for a CPU would look like a program that never ends.
    """
    load: float = os.getloadavg()[0] / (os.cpu_count() or 1)
    return seconds * min(max(load, 1.0), MOST)


@contextmanager
def interrupt_after(seconds: float, error: type[BaseException], repeat: float = 0.0) -> Iterator[None]:
    """Raise the error in the `with` block when the block has run for `seconds` s.

    If `repeat` is not 0, the error is raised repeatedly, because code may catch the first error. `repeat` is
    the time in s between two errors. This function uses an alarm signal (SIGALRM). The block therefore has to
    run in the main thread, and must not contain another such block. In any other thread, the function raises
    ValueError.
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
