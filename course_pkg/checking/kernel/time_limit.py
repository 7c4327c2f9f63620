"""Runs a student's function within a time limit, even if the function catches all exceptions.

A loop with a bare `except` catches every exception that is raised within its `try`. So each exception is
immediately raised again, at the next point where Python handles signals. This point is in the `except` block
or after it, so it is outside of the `try`. While a library cleans up, for example while it releases a lock,
it is not interrupted.
"""

from __future__ import annotations

import _thread
import signal
import time
from collections.abc import Callable
from functools import partial
from types import FrameType
from typing import Any, TypeVar

from course_pkg.ros.notebook.tracebacks import is_students

REPEAT = 0.2  # s between two attempts to end a call that waits in a library

Value = TypeVar("Value")


class TimesUp(BaseException):
    """The time for a student's function is over. `except Exception` does not catch this exception."""


class TimeLimit:
    """Calls functions in the main thread, and ends each call that takes longer than `seconds`."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._error = _coming_again(TimesUp)
        self._raised = 0.0  # the time at which an exception was last raised in a library
        self._stopped = False  # whether the Stop button ended the call

    def call(self, function: Callable[[], Value]) -> Value:
        """Return the result of `function`. Raises TimesUp, or KeyboardInterrupt after the Stop button."""
        alarm = signal.signal(signal.SIGALRM, self._end)
        interrupt = signal.signal(signal.SIGINT, self._stop)
        signal.setitimer(signal.ITIMER_REAL, self._seconds, REPEAT)
        try:
            return _call(function)
        finally:
            signal.signal(signal.SIGINT, interrupt)
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, alarm)
            if self._stopped:  # needed because the function may have caught the exception
                raise KeyboardInterrupt

    def _stop(self, _number: int, frame: FrameType | None) -> None:
        """Raise KeyboardInterrupt as Python does, and raise it again until the function ends."""
        self._stopped = True
        self._error = _coming_again(KeyboardInterrupt)
        signal.setitimer(signal.ITIMER_REAL, REPEAT, REPEAT)
        if _is_called(frame):
            raise KeyboardInterrupt

    def _end(self, _number: int, frame: FrameType | None) -> None:
        """Raise the error in the student's code, or in the library in which the student's code waits."""
        if frame is None or not _is_called(frame):
            return
        now = time.monotonic()
        if is_students(frame.f_code.co_filename) or now - self._raised > REPEAT / 2:
            self._raised = now
            raise self._error
        try:
            raise self._error  # the signal becomes pending again, and the library can clean up
        except BaseException:  # noqa: BLE001
            return


def _call(function: Callable[[], Value]) -> Value:
    """Call `function`; it runs as long as this frame is on the stack."""
    return function()


def _is_called(frame: FrameType | None) -> bool:
    """Return whether `frame` belongs to a function that _call() has called."""
    if frame is not None and frame.f_code is _call.__code__:
        return False
    while frame is not None and frame.f_code is not _call.__code__:
        frame = frame.f_back
    return frame is not None


def _coming_again(error: type[BaseException]) -> type[BaseException]:
    """Return a subclass of `error`; each new instance makes SIGALRM pending.

    `raise` creates the instance. Python handles no signals until the exception has left the function that
    raises it. If a function call created the instance, Python could handle signals at that point.
    """
    again: Any = staticmethod(partial(_thread.interrupt_main, signal.SIGALRM))
    return type(error.__name__, (error,), {"__init__": again})
