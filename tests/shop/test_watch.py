"""What a camera says reaches those who wait for it, at once and all of them."""

from __future__ import annotations

import time
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import count

import pytest

from course_pkg.errors import CameraSilent
from course_pkg.shop import Customer, Watch
from tests.support import eventually

FOR_EVER = 60.0  # s: longer than any test


def test_who_comes_is_told_once() -> None:
    """A customer is new with the first message in which they are, and keeps the time of it."""
    ticks = count(1)
    watch = Watch(lambda: next(ticks))
    assert watch.see([]) == []
    assert watch.see([4]) == [Customer(4, 1)]
    assert watch.see([4]) == []
    assert watch.see([4, 5]) == [Customer(5, 2)]
    assert (watch.next(), watch.next(4), watch.count) == (Customer(4, 1), Customer(5, 2), 2)


def test_who_goes_is_forgotten() -> None:
    """Somebody who is gone is nobody to wait for; somebody who comes back is new."""
    watch = Watch()
    watch.see([1])
    watch.see([])
    assert watch.next() is None
    assert [customer.number for customer in watch.see([1])] == [1]


def test_one_who_goes_as_another_comes() -> None:
    """The number of those who are there may stay the same."""
    watch = Watch()
    watch.see([1])
    watch.see([2])
    assert watch.see([2]) == []
    assert watch.next(1) == watch.next()


def test_a_wait_ends_at_once_where_somebody_is_there() -> None:
    """Nobody waits for what has happened already."""
    watch = Watch()
    watch.see([3])
    customer = watch.wait(0, FOR_EVER, FOR_EVER)
    assert customer is not None
    assert customer.number == 3


def test_all_who_wait_are_woken() -> None:
    """Each gets the customer that it waits for, and no other one."""
    watch = Watch()
    watch.see([1])
    with ThreadPoolExecutor(4) as pool:
        waiting = [pool.submit(watch.wait, after, FOR_EVER, FOR_EVER) for after in (1, 1, 2, 2)]
        watch.see([1, 2])
        assert [_number(future) for future in waiting[:2]] == [2, 2]
        assert not any(future.done() for future in waiting[2:])
        watch.see([3])
        assert [_number(future) for future in waiting[2:]] == [3, 3]


def _number(future: Future[Customer | None]) -> int | None:
    customer = future.result(10)
    return customer.number if customer else None


def test_a_wait_ends_with_its_patience() -> None:
    """None, and not before the time is over."""
    watch = Watch()
    watch.see([])
    began = time.monotonic()
    assert watch.wait(0, 0.2, FOR_EVER) is None
    assert time.monotonic() - began >= 0.2


def test_a_wait_ends_when_the_camera_is_silent() -> None:
    """Whoever waits for a camera that is gone waits for nothing, and what it said last is no news."""
    watch = Watch()
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=5.0)  # it has never said anything
    watch.see([1])
    eventually(lambda: watch.silent_for > 0.05)
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=0.05)
