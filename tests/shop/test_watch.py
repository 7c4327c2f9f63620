"""Tests of Watch and Eye, which read the messages of a camera."""

from __future__ import annotations

import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import count

import pytest

from course_pkg.errors import CameraSilent
from course_pkg.shop import Customer, Eye, Watch, await_customer
from course_pkg.shop import watch as module
from tests.support import eventually

FOR_EVER = 60.0  # in s; longer than any test


def test_a_new_customer_is_returned_once() -> None:
    """If a customer is seen twice, the second see() does not return this customer."""
    ticks = count(1)
    watch = Watch(lambda: next(ticks))
    assert watch.see([]) == []
    assert watch.see([4]) == [Customer(4, 1)]
    assert watch.see([4]) == []
    assert watch.see([4, 5]) == [Customer(5, 2)]
    assert (watch.next(), watch.next(4), watch.count) == (Customer(4, 1), Customer(5, 2), 2)


def test_a_customer_who_has_left_is_forgotten() -> None:
    """A customer who leaves and comes back is a new customer."""
    watch = Watch()
    watch.see([1])
    watch.see([])
    assert watch.next() is None
    assert [customer.number for customer in watch.see([1])] == [1]


def test_one_customer_replaces_another() -> None:
    """The watch finds a new customer even if another customer leaves at the same time."""
    watch = Watch()
    watch.see([1])
    watch.see([2])
    assert watch.see([2]) == []
    assert watch.next(1) == watch.next()


def test_a_wait_ends_at_once_if_a_customer_is_there() -> None:
    """`wait` returns immediately if a customer is present."""
    watch = Watch()
    watch.see([3])
    customer = watch.wait(0, FOR_EVER, FOR_EVER)
    assert customer is not None
    assert customer.number == 3


def test_all_waiting_threads_are_notified() -> None:
    """Each thread waits until a customer comes who has a number above the thread's limit `after`."""
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


def test_a_wait_without_a_customer_ends_after_its_time() -> None:
    """If no customer comes, `wait` returns None when its time limit is over."""
    watch = Watch()
    watch.see([])
    began = time.monotonic()
    assert watch.wait(0, 0.2, FOR_EVER) is None
    assert time.monotonic() - began >= 0.2


def test_a_wait_ends_when_the_camera_is_silent() -> None:
    """If the camera sends no message for longer than the limit `silence`, `wait` raises CameraSilent."""
    watch = Watch()
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=5.0)  # The camera has never published a message.
    watch.see([1])
    eventually(lambda: watch.silent_for > 0.05)
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=0.05)


def sees(frame: str) -> bool:
    """Return whether the fake picture, which is a string, shows a customer."""
    if frame == "malformed":
        raise ValueError(frame)
    return frame == "a customer"


@pytest.fixture
def eye() -> Eye:
    """Return an Eye that has received no picture."""
    return Eye(sees)


def test_only_the_newest_good_frame_counts(eye: Eye) -> None:
    """If the newest picture is malformed, the Eye uses the last valid picture."""
    seen = [eye.look()]
    for frame in ("a customer", "malformed", "no customer", "malformed"):
        eye.hear(frame)
        seen.append(eye.look())
    assert seen == [None, True, True, False, False]


def test_an_old_frame_is_not_used(eye: Eye, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the newest valid picture is older than FRAME_TIMEOUT, look() returns None."""
    eye.hear("a customer")
    monkeypatch.setattr(module, "FRAME_TIMEOUT", -1.0)
    eye.hear("malformed")
    assert eye.look() is None


def test_a_customer_is_found_without_waiting(eye: Eye) -> None:
    """If a customer is present, `await_customer` returns True even with a limit of 0 s."""
    eye.hear("a customer")
    assert await_customer(eye, 0.0) is True


def test_a_wait_ends_with_the_customer_who_comes(eye: Eye) -> None:
    """The first picture with a customer ends the waiting of all threads."""
    eye.hear("no customer")
    with ThreadPoolExecutor(4) as pool:
        waits = [pool.submit(await_customer, eye, 30.0) for _ in range(4)]
        for frame in ("no customer", "malformed", "no customer", "a customer"):
            eye.hear(frame)
        assert [wait.result(20) for wait in waits] == [True] * 4


def test_a_wait_without_a_customer_is_bounded(eye: Eye) -> None:
    """Without a customer, `await_customer` returns after its time limit."""
    over = threading.Event()

    def stream() -> None:
        while not over.wait(0.01):
            eye.hear("no customer")

    eye.hear("no customer")
    camera = threading.Thread(target=stream)
    camera.start()
    started = time.monotonic()
    try:
        assert await_customer(eye, 0.2) is False
        assert time.monotonic() - started < 10.0
    finally:
        over.set()
        camera.join()


def test_a_silent_camera_is_an_error(eye: Eye) -> None:
    """If no picture arrives within the time limit, `await_customer` raises CameraSilent."""
    with pytest.raises(CameraSilent):
        await_customer(eye, 0.05)
