"""Run a student's function with a time limit, even if the function catches all exceptions.

A loop with a bare `except` catches every exception in its `try` block. Python therefore raises the exception
a second time, when it next handles signals. By then, the `except` block is running or has ended, so the loop
cannot catch the second exception.

No exception is raised while a library cleans up, for example while it releases a lock.
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

REPEAT = 0.2  # This is the time in s between two attempts to end a call that waits in a library.

Value = TypeVar("Value")


class TimesUp(BaseException):
    """The time limit of a student's function is over; `except Exception` does not catch this exception."""


class TimeLimit:
    """Calls functions in the main thread, and ends a call that takes longer than the time limit.

    `seconds` is the time limit in s.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._error = _coming_again(TimesUp)
        # This is the last time (s) at which _end() raised the error in the running code.
        self._raised = 0.0
        self._stopped = False  # The user has pressed the Stop button.

    def call(self, function: Callable[[], Value]) -> Value:
        """Call the function `function`, and return its result.

        Raises TimesUp after the time limit, and KeyboardInterrupt after the user has pressed Stop.
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
            if self._stopped:  # The function may have caught the KeyboardInterrupt.
                raise KeyboardInterrupt

    def _stop(self, _number: int, frame: FrameType | None) -> None:
        """Handle the Stop button: raise KeyboardInterrupt repeatedly until the function ends."""
        self._stopped = True
        self._error = _coming_again(KeyboardInterrupt)
        signal.setitimer(signal.ITIMER_REAL, REPEAT, REPEAT)
        if _is_called(frame):
            raise KeyboardInterrupt

    def _end(self, _number: int, frame: FrameType | None) -> None:
        """Raise the error at the current line of the student's code, or of a library that the code called."""
        if frame is None or not _is_called(frame):
            return
        now = time.monotonic()
        if is_students(frame.f_code.co_filename) or now - self._raised > REPEAT / 2:
            self._raised = now
            raise self._error
        try:
            # This statement sends SIGALRM again, so _end() runs again soon. Until then, the library can clean
            # up.
            raise self._error
        except BaseException:  # noqa: BLE001
            return


def _call(function: Callable[[], Value]) -> Value:
    """Run the function `function`; _is_called() searches the stack for the frame of this call."""
    return function()


def _is_called(frame: FrameType | None) -> bool:
    """Return whether `frame` belongs to a function that was called by _call()."""
    if frame is not None and frame.f_code is _call.__code__:
        return False
    while frame is not None and frame.f_code is not _call.__code__:
        frame = frame.f_back
    return frame is not None


def _coming_again(error: type[BaseException]) -> type[BaseException]:
    """Return a subclass of `error`; an instance sends SIGALRM to this process when it is created.

    Raise the returned class, not an instance. The `raise` statement then creates the instance. Python handles
    the new signal only after the exception has left the function. If the instance existed before the `raise`
    statement, Python could handle the signal too early.
    """
    again: Any = staticmethod(partial(_thread.interrupt_main, signal.SIGALRM))
    return type(error.__name__, (error,), {"__init__": again})
