"""The time limit and the Stop button end a student's function that catches all exceptions."""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import threading
import time
from collections.abc import Callable

import pytest

from course_pkg.checking.kernel.time_limit import TimeLimit, TimesUp

LIMIT = 0.2
SOON = 3.0  # On a busy machine, a function ends within this time in s after its time limit.
LOCK = threading.Lock()


def busy() -> None:
    """Run an endless calculation."""
    while True:
        try:
            while True:
                pass
        except:  # noqa: E722, S110 -- as in a student's code
            pass


def prints() -> None:
    """Catch all exceptions in an endless loop, and print a text after each exception."""
    while True:
        try:
            time.sleep(0.01)
        except:  # noqa: E722
            print("caught")  # noqa: T201


def waits() -> None:
    """Wait in a library function that has clean-up code."""
    while True:
        try:
            threading.Event().wait()
        except:  # noqa: E722
            time.sleep(0.001)


def nested() -> None:
    """Catch all exceptions in two nested try statements."""
    while True:
        try:
            try:  # noqa: SIM105
                time.sleep(1)
            except:  # noqa: E722, S110
                pass
        except:  # noqa: E722, S110
            pass


def goes_on() -> None:
    """Suppress exceptions with `continue` in `finally`."""
    while True:
        try:
            time.sleep(1)
        finally:
            continue  # noqa: B012


def locks() -> None:
    """Hold a lock during an endless loop."""
    while True:
        try:
            with LOCK:
                time.sleep(0.01)
        except:  # noqa: E722, S112
            continue


def suppresses() -> None:
    """Use a context manager that suppresses all exceptions."""
    while True:
        with contextlib.suppress(BaseException):
            queue.Queue[int]().get()


STUBBORN = pytest.mark.parametrize(
    "function", [busy, prints, waits, nested, goes_on, locks, suppresses], ids=lambda each: each.__name__
)


@STUBBORN
def test_limit_ends_it(function: Callable[[], None]) -> None:
    """Each function ends at its time limit, and the lock is free afterwards."""
    started = time.monotonic()
    with pytest.raises(TimesUp):
        TimeLimit(LIMIT).call(function)
    assert time.monotonic() - started < LIMIT + SOON
    assert not LOCK.locked()


@STUBBORN
def test_stop_button_ends_it(function: Callable[[], None]) -> None:
    """Each function ends after the first interrupt."""
    started = time.monotonic()
    threading.Timer(LIMIT, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        TimeLimit(60).call(function)
    assert time.monotonic() - started < LIMIT + SOON


def test_function_that_ends_in_time() -> None:
    """A function that ends in time returns its value or raises its error."""
    before = signal.getsignal(signal.SIGALRM), signal.getsignal(signal.SIGINT)
    assert TimeLimit(LIMIT).call(lambda: 7) == 7
    with pytest.raises(ZeroDivisionError):
        TimeLimit(LIMIT).call(lambda: 1 // 0)
    assert (signal.getsignal(signal.SIGALRM), signal.getsignal(signal.SIGINT)) == before
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)


def test_stop_button_is_not_swallowed() -> None:
    """If a function catches the interrupt, the call still raises KeyboardInterrupt."""

    def swallows() -> int:
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        return 7

    with pytest.raises(KeyboardInterrupt):
        TimeLimit(LIMIT).call(swallows)
