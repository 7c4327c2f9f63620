"""One thread bounds all calls, and ends when there are none."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from course_pkg.graph import watchdog
from course_pkg.graph.watchdog import Watchdog
from tests.support import eventually


@contextmanager
def switching_often() -> Iterator[None]:
    """Have Python change threads all the time, so that what may come in between does."""
    kept = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        yield
    finally:
        sys.setswitchinterval(kept)


def watching() -> list[threading.Thread]:
    """The threads of watchdogs, this test's own and whoever's."""
    return [thread for thread in threading.enumerate() if thread.name == "call-watchdog"]


def test_an_action_is_repeated_until_it_is_disarmed() -> None:
    """What is due is done again and again, and never once it is disarmed."""
    guard, done = Watchdog(), list[float]()
    number = guard.arm(time.monotonic(), lambda: done.append(time.monotonic()))
    eventually(lambda: len(done) >= 3)
    guard.disarm(number)
    _round(guard)
    counted = len(done)
    _round(guard)
    assert len(done) == counted


def _round(guard: Watchdog) -> None:
    """Return when the thread has begun another round, and has ended the one before."""
    told = threading.Event()
    number = guard.arm(time.monotonic(), told.set)
    assert told.wait(5)
    guard.disarm(number)


def test_no_thread_is_left_when_nothing_is_armed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The thread ends some time after the last call, and the next call gets another."""
    monkeypatch.setattr(watchdog, "LINGER", 0.05)
    before = set(watching())
    guard = Watchdog()
    for _ in range(2):
        guard.disarm(guard.arm(time.monotonic() + 60, lambda: None))
        assert set(watching()) - before
        eventually(lambda: not set(watching()) - before)
    rung = threading.Event()
    guard.arm(time.monotonic() + 0.01, rung.set)
    assert rung.wait(5)


def test_no_deadline_is_missed_while_the_thread_comes_and_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whenever a deadline is set, also in the moment in which the thread ends, it is kept."""
    monkeypatch.setattr(watchdog, "LINGER", 0.0005)
    guard, missed = Watchdog(), list[int]()

    def caller() -> None:
        for turn in range(150):
            rung = threading.Event()
            number = guard.arm(time.monotonic() + turn % 7 * 0.0003, rung.set)
            if not rung.wait(5):
                missed.append(turn)
            guard.disarm(number)

    with switching_often():
        callers = [threading.Thread(target=caller) for _ in range(4)]
        for thread in callers:
            thread.start()
        for thread in callers:
            thread.join(60)
    assert missed == []
