"""A publisher that sends messages to the student's subscriber."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Iterable, Mapping

import genpy
import rospy

from course_pkg.checking.assertions import Hints, Results, hint_for
from course_pkg.checking.plain_values import Message, ServiceClass, Value
from course_pkg.waiting import wait_until


class Publisher:
    """Publishes its messages on the topic `topic` in a cycle; the time between two messages is `every` s.

    If `once` is true, the publisher begins as soon as there is a subscriber, and ends after the last message.
    `sent` contains the times of the messages in s of time.monotonic(). `subscribers` contains the number of
    connected subscribers at each of these times. A disconnected subscriber may be counted for two more
    messages.
    """

    def __init__(
        self,
        results: Results,
        topic: str,
        kind: ServiceClass,
        messages: Iterable[Mapping[str, Value]],
        *,
        every: float,
        once: bool,
        label: str,
    ) -> None:
        self.sent: list[float] = []
        self.subscribers: list[int] = []
        self._results, self._type = results, str(kind._type)
        self._label = label  # Assertions show this text for the topic.
        self._messages = [_made(kind, fields) for fields in messages]
        self._every = every
        self._once = once
        self._over = threading.Event()
        self._done = threading.Event()
        self._publisher = rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True)

    def has_subscriber(self, within: float = 2.0) -> bool:
        """Wait until there is a subscriber, for at most `within` (s); return whether there is one."""
        return bool(wait_until(self._publisher.get_num_connections, within, stopped=self._over))

    def listened(self, *, hints: Hints = (), within: float = 3.0) -> None:
        """Assert that a subscriber of the right type exists, and wait until it is connected.

        `hints` are for the value "no subscriber"; a subscriber with another type does not count.
        """
        assertion = f"{self._label} has a subscriber"
        if not self.has_subscriber(within):
            hint = (
                hint_for(hints, "no subscriber")
                or "No node is subscribed to this topic. Create a rospy.Subscriber of type "
                f"{self._type} for this topic."
            )
            self._results.fails(assertion, expected="a subscriber", actual="no subscriber", hint=hint)
        self._results.passes(assertion)

    def finish(self, within: float = 10.0) -> bool:
        """Wait for the last message if `once` is true; return whether it was published.

        The maximum waiting time is `within` (s).
        """
        return self._done.wait(within)

    def stop(self) -> None:
        """Stop publishing, but stay registered as a publisher."""
        self._over.set()

    def __enter__(self) -> Publisher:
        threading.Thread(target=self._publish, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
        self._publisher.unregister()

    def _publish(self) -> None:
        if self._once:
            while not self._over.is_set() and not self.has_subscriber(1.0):
                pass
        for message in self._messages if self._once else itertools.cycle(self._messages):
            if self._over.wait(self._every):
                return
            self.subscribers.append(self._publisher.get_num_connections())
            self.sent.append(time.monotonic())
            self._publisher.publish(message)
        self._done.set()


def _made(kind: ServiceClass, fields: Mapping[str, Value]) -> Message:
    """Return a message with these fields; a dict in `fields` contains the fields of a nested message."""
    message = kind()
    genpy.message.fill_message_args(message, [dict(fields)])
    return message
