"""Runs a student's function with a time limit, even if the function catches all exceptions.

A loop with a bare `except` catches every exception that is raised in its `try` block. Therefore, the
exception is raised again at once, at the next point where Python handles signals. This point is in the
`except` block or after it, so the loop cannot catch the exception. While a library cleans up, for example
releases a lock, no exception is raised in it.
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

REPEAT = 0.2  # s between two attempts to end a call that is waiting in a library

Value = TypeVar("Value")


class TimesUp(BaseException):
    """The time limit of a student's function is reached; `except Exception` does not catch this exception.

    `except Exception` does not catch this exception.
    """


class TimeLimit:
    """Calls functions in the main thread, and ends a call that takes longer than `seconds`."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._error = _coming_again(TimesUp)
        self._raised = 0.0  # the time at which an exception was last raised in a library's code
        self._stopped = False  # whether the user pressed the Stop button

    def call(self, function: Callable[[], Value]) -> Value:
        """Return the result of `function`.

        Raises TimesUp after the time limit, and KeyboardInterrupt after the Stop button.
        """
        alarm = signal.signal(signal.SIGALRM, self._end)
        interrupt = signal.signal(signal.SIGINT, self._stop)
        signal.setitimer(signal.ITIMER_REAL, self._seconds, REPEAT)
        try:
            return _call(function)
        finally:
            signal.signal(signal.SIGINT, interrupt)
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, alarm)
            if self._stopped:  # checked here, because the function may have caught the exception
                raise KeyboardInterrupt

    def _stop(self, _number: int, frame: FrameType | None) -> None:
        """Raise KeyboardInterrupt as Python does, again and again until the function ends."""
        self._stopped = True
        self._error = _coming_again(KeyboardInterrupt)
        signal.setitimer(signal.ITIMER_REAL, REPEAT, REPEAT)
        if _is_called(frame):
            raise KeyboardInterrupt

    def _end(self, _number: int, frame: FrameType | None) -> None:
        """Raise the error in the student's code, or in the library that the student's code is waiting in."""
        if frame is None or not _is_called(frame):
            return
        now = time.monotonic()
        if is_students(frame.f_code.co_filename) or now - self._raised > REPEAT / 2:
            self._raised = now
            raise self._error
        try:
            raise self._error  # the signal becomes pending again after this, and the library can clean up
        except BaseException:  # noqa: BLE001
            return


def _call(function: Callable[[], Value]) -> Value:
    """Run `function`; while it runs, this frame is on the stack."""
    return function()


def _is_called(frame: FrameType | None) -> bool:
    """Return whether `frame` belongs to a function that was called by _call()."""
    if frame is not None and frame.f_code is _call.__code__:
        return False
    while frame is not None and frame.f_code is not _call.__code__:
        frame = frame.f_back
    return frame is not None


def _coming_again(error: type[BaseException]) -> type[BaseException]:
    """Return a subclass of `error` whose new instances make SIGALRM pending again.

    The `raise` statement creates the instance. After this, Python handles no signals until the exception has
    left the function that raises it. If a function call created the instance, Python could handle the signal
    too early.
    """
    again: Any = staticmethod(partial(_thread.interrupt_main, signal.SIGALRM))
    return type(error.__name__, (error,), {"__init__": again})
