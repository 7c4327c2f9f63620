"""A camera's news reaches all waiting threads at once."""

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

FOR_EVER = 60.0  # s: longer than any test


def test_who_comes_is_told_once() -> None:
    """A customer is new in the first message that contains them; the time of this message is kept."""
    ticks = count(1)
    watch = Watch(lambda: next(ticks))
    assert watch.see([]) == []
    assert watch.see([4]) == [Customer(4, 1)]
    assert watch.see([4]) == []
    assert watch.see([4, 5]) == [Customer(5, 2)]
    assert (watch.next(), watch.next(4), watch.count) == (Customer(4, 1), Customer(5, 2), 2)


def test_who_goes_is_forgotten() -> None:
    """A customer who has left is not returned; one who comes back is new."""
    watch = Watch()
    watch.see([1])
    watch.see([])
    assert watch.next() is None
    assert [customer.number for customer in watch.see([1])] == [1]


def test_one_who_goes_as_another_comes() -> None:
    """A new customer is found even if the number of customers is unchanged."""
    watch = Watch()
    watch.see([1])
    watch.see([2])
    assert watch.see([2]) == []
    assert watch.next(1) == watch.next()


def test_a_wait_ends_at_once_where_somebody_is_there() -> None:
    """A thread does not wait if a customer is there already."""
    watch = Watch()
    watch.see([3])
    customer = watch.wait(0, FOR_EVER, FOR_EVER)
    assert customer is not None
    assert customer.number == 3


def test_all_who_wait_are_woken() -> None:
    """Each thread gets the customer for whom it waits."""
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
    """The result is None, not before the end of the time."""
    watch = Watch()
    watch.see([])
    began = time.monotonic()
    assert watch.wait(0, 0.2, FOR_EVER) is None
    assert time.monotonic() - began >= 0.2


def test_a_wait_ends_when_the_camera_is_silent() -> None:
    """A wait ends if the camera is silent, and its last message does not count as new."""
    watch = Watch()
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=5.0)  # it has never published anything
    watch.see([1])
    eventually(lambda: watch.silent_for > 0.05)
    with pytest.raises(CameraSilent):
        watch.wait(0, FOR_EVER, silence=0.05)


def sees(frame: str) -> bool:
    """Look at a frame that is text."""
    if frame == "malformed":
        raise ValueError(frame)
    return frame == "somebody"


@pytest.fixture
def eye() -> Eye:
    """Return a detector that has seen no frame."""
    return Eye(sees)


def test_only_the_newest_good_frame_counts(eye: Eye) -> None:
    """A malformed frame reports no customer, and ends the last report."""
    seen = [eye.look()]
    for frame in ("somebody", "malformed", "nobody", "malformed"):
        eye.hear(frame)
        seen.append(eye.look())
    assert seen == [None, True, True, False, False]


def test_knowledge_grows_old(eye: Eye, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a valid frame for a while, the result is unknown."""
    eye.hear("somebody")
    monkeypatch.setattr(module, "FRAME_TIMEOUT", -1.0)
    eye.hear("malformed")
    assert eye.look() is None


def test_a_customer_is_found_without_waiting(eye: Eye) -> None:
    """A customer is found even with a timeout of 0 s."""
    eye.hear("somebody")
    assert await_customer(eye, 0.0) is True


def test_a_wait_ends_with_the_customer_who_comes(eye: Eye) -> None:
    """All waiting threads continue, and frames without a customer do not end their wait."""
    eye.hear("nobody")
    with ThreadPoolExecutor(4) as pool:
        waits = [pool.submit(await_customer, eye, 30.0) for _ in range(4)]
        for frame in ("nobody", "malformed", "nobody", "somebody"):
            eye.hear(frame)
        assert [wait.result(20) for wait in waits] == [True] * 4


def test_a_wait_without_a_customer_is_bounded(eye: Eye) -> None:
    """Frames that arrive all the time do not extend the wait."""
    over = threading.Event()

    def stream() -> None:
        while not over.wait(0.01):
            eye.hear("nobody")

    eye.hear("nobody")
    camera = threading.Thread(target=stream)
    camera.start()
    started = time.monotonic()
    try:
        assert await_customer(eye, 0.2) is False
        assert time.monotonic() - started < 10.0
    finally:
        over.set()
        camera.join()


def test_a_silent_camera_is_no_answer(eye: Eye) -> None:
    """If the time ends while the result is unknown, this is reported."""
    with pytest.raises(CameraSilent):
        await_customer(eye, 0.05)
