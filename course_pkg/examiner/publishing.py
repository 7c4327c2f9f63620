"""A topic for the student's subscriber."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Iterable

import rospy

from course_pkg.examiner.plain import Plain


class Publishing:
    """Publishes one message after the other on `topic`, every `every` s, and starts again after the last."""

    def __init__(self, topic: str, kind: type, messages: Iterable[Plain], every: float) -> None:
        self._messages = [kind(**message) for message in messages]
        self._every = every
        self._over = threading.Event()
        self._publisher = rospy.Publisher(topic, kind, queue_size=100)

    def __enter__(self) -> Publishing:
        threading.Thread(target=self._publish, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._publisher.unregister()

    def _publish(self) -> None:
        for message in itertools.cycle(self._messages):
            if self._over.wait(self._every):
                return
            self._publisher.publish(message)
