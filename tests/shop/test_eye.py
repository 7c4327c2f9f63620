"""An eye knows what the newest good frame shows, and a wait at it is bounded."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from course_pkg.errors import CameraSilent
from course_pkg.shop import Eye, await_customer
from course_pkg.shop import eye as module


def sees(frame: str) -> bool:
    """Look at a frame that is a word."""
    if frame == "malformed":
        raise ValueError(frame)
    return frame == "somebody"


@pytest.fixture
def eye() -> Eye:
    """An eye that has seen nothing yet."""
    return Eye(sees)


def test_only_the_newest_good_frame_counts(eye: Eye) -> None:
    """What is malformed says nothing, and what was before is over."""
    seen = [eye.look()]
    for frame in ("somebody", "malformed", "nobody", "malformed"):
        eye.hear(frame)
        seen.append(eye.look())
    assert seen == [None, True, True, False, False]


def test_knowledge_grows_old(eye: Eye, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a good frame for a while nobody can tell."""
    eye.hear("somebody")
    monkeypatch.setattr(module, "SILENCE", -1.0)
    eye.hear("malformed")
    assert eye.look() is None


def test_who_is_there_is_found_without_waiting(eye: Eye) -> None:
    """Also with no patience at all."""
    eye.hear("somebody")
    assert await_customer(eye, 0.0) is True


def test_a_wait_ends_with_the_customer_who_comes(eye: Eye) -> None:
    """For everybody who waits, and frames with nobody in between do not end it."""
    eye.hear("nobody")
    with ThreadPoolExecutor(4) as pool:
        waits = [pool.submit(await_customer, eye, 30.0) for _ in range(4)]
        for frame in ("nobody", "malformed", "nobody", "somebody"):
            eye.hear(frame)
        assert [wait.result(20) for wait in waits] == [True] * 4


def test_a_wait_in_vain_is_bounded(eye: Eye) -> None:
    """Frames that come all the time do not make it longer."""
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
    """When the time is over and nobody can tell, that is what is said."""
    with pytest.raises(CameraSilent):
        await_customer(eye, 0.05)
