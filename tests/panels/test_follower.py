"""Looking again and again, telling only of changes."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from course_pkg.panels.follower import Follower
from tests.support import eventually


class Scene:
    """Something to look at, and what was told of it."""

    def __init__(self) -> None:
        self.now: object = 1
        self.looks = 0
        self.seen: list[object] = []
        self.failed: list[str] = []
        self.follower = Follower(
            self.look, self.seen.append, lambda error: self.failed.append(str(error)), every=0.001
        )

    def look(self) -> object:
        """See what is there now."""
        self.looks += 1
        if isinstance(self.now, Exception):
            raise self.now
        return self.now

    def looked_again(self) -> bool:
        """Wait for further looks."""
        before = self.looks
        return eventually(lambda: self.looks > before + 2)


@pytest.fixture
def scene() -> Iterator[Scene]:
    """End what the test began."""
    scene = Scene()
    yield scene
    scene.follower.stop()
    eventually(lambda: not followers())


def followers() -> list[threading.Thread]:
    """Find the threads that follow something."""
    return [thread for thread in threading.enumerate() if thread.name == "panel-follower"]


def test_a_sight_is_told_once(scene: Scene) -> None:
    """Looking at the same thing again tells nothing."""
    scene.follower.start()
    eventually(lambda: scene.seen)
    assert scene.looked_again()
    scene.now = 2
    eventually(lambda: len(scene.seen) == 2)
    assert scene.seen == [1, 2]


def test_an_error_is_told_once_and_recovery_is_told(scene: Scene) -> None:
    """The same error again tells nothing; a sight that returns after it is told, even an old one."""
    scene.now = OSError("gone")
    scene.follower.start()
    eventually(lambda: scene.failed)
    assert scene.looked_again()
    scene.now = 1
    eventually(lambda: scene.seen)
    assert scene.failed == ["gone"]


def test_an_error_in_the_listener_does_not_end_the_thread(scene: Scene) -> None:
    """What the listener raises is told as a failure, and the next change is still seen."""
    heard: list[object] = []

    def listen(sight: object) -> None:
        heard.append(sight)
        raise ValueError("listener")

    scene.follower = Follower(scene.look, listen, lambda error: scene.failed.append(str(error)), every=0.001)
    scene.follower.start()
    eventually(lambda: scene.failed)
    scene.now = 2
    eventually(lambda: 2 in heard)


def test_stop_ends_the_thread(scene: Scene) -> None:
    """After stop no thread is left, and start begins anew."""
    scene.follower.start()
    scene.follower.start()
    eventually(lambda: scene.seen)
    assert len(followers()) == 1
    scene.follower.stop()
    eventually(lambda: not followers())
    scene.follower.start()
    eventually(lambda: len(scene.seen) == 2)
