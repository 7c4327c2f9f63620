"""A topic for the student's subscriber."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Iterable

import genpy
import rospy

from course_pkg.examiner.ledger import Hints, Ledger, hint_for
from course_pkg.examiner.plain import Message, Plain, ServiceClass

LOOK = 0.01  # s between looks at who listens


class Publishing:
    """Publishes one message after the other on `topic`, every `every` s, and starts again after the last.

    With `once` it begins as soon as somebody listens, and ends after the last. `sent` are the times of
    time.monotonic() at which messages went out, in s.
    """

    def __init__(
        self,
        ledger: Ledger,
        topic: str,
        kind: ServiceClass,
        messages: Iterable[Plain],
        *,
        every: float,
        once: bool,
        label: str,
    ) -> None:
        self.sent: list[float] = []
        self._ledger, self._label, self._type = (
            ledger,
            label,
            str(kind._type),
        )  # the label is how rules call it
        self._messages = [_made(kind, fields) for fields in messages]
        self._every = every
        self._once = once
        self._over = threading.Event()
        self._done = threading.Event()
        self._publisher = rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True)

    def heard(self, within: float = 2.0) -> bool:
        """Return whether somebody listens, as soon as somebody does, at the latest after `within` s."""
        deadline = time.monotonic() + within
        while not self._publisher.get_num_connections() and time.monotonic() < deadline:
            if self._over.wait(LOOK):
                break
        return bool(self._publisher.get_num_connections())

    def listened(self, *, hints: Hints = (), within: float = 3.0) -> None:
        """Hold that somebody listens to the topic, and return when the connection stands.

        `hints` are for "nobody"; who subscribes in another type is nobody, too.
        """
        rule = f"somebody listens to {self._label}"
        if not self.heard(within):
            hint = hint_for(hints, "nobody") or f"Make a rospy.Subscriber for it, of type {self._type}."
            self._ledger.fails(rule, expected="a subscriber", seen="nobody", hint=hint)
        self._ledger.passes(rule)

    def finish(self, within: float = 10.0) -> bool:
        """Wait until the last message is out, with `once`; return whether it is, after `within` s at most."""
        return self._done.wait(within)

    def stop(self) -> None:
        """Publish nothing more, and stay on the graph as one who could."""
        self._over.set()

    def __enter__(self) -> Publishing:
        threading.Thread(target=self._publish, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
        self._publisher.unregister()

    def _publish(self) -> None:
        if self._once:
            self._await_listener()
        for message in self._messages if self._once else itertools.cycle(self._messages):
            if self._over.wait(self._every):
                return
            self.sent.append(time.monotonic())
            self._publisher.publish(message)
        self._done.set()

    def _await_listener(self) -> None:
        while not self._over.is_set() and not self.heard(1.0):
            pass


def _made(kind: ServiceClass, fields: Plain) -> Message:
    """Return a message with these fields, in which a message is a dict as well."""
    message = kind()
    genpy.message.fill_message_args(message, [dict(fields)])
    return message
