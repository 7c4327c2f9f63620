"""A subscription that stores its messages; a cell can then wait for messages without a callback."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING

import rospy

from course_pkg.errors import NothingHeard
from course_pkg.ros.node.type_lookup import Message
from course_pkg.ros.protocol.master_api import MasterClient, master_uri

if TYPE_CHECKING:
    from course_pkg.types import MessageClass

CAPACITY = 1000  # The list `messages` stores at most this many messages.

Callback = Callable[[Message], object]


class Subscription:
    """A subscription: `messages` contains the last 1000 messages, the oldest message first.

    `errors` contains the last 1000 exceptions of `callback`.
    """

    def __init__(self, topic: str, cls: MessageClass, callback: Callback | None = None) -> None:
        self.messages: deque[Message] = deque(maxlen=CAPACITY)
        self.errors: deque[Exception] = deque(maxlen=CAPACITY)
        self.count = 0
        self._callback = callback
        self._arrived = threading.Condition()
        self._cls = cls
        self.name = str(rospy.resolve_name(topic))
        self.type = cls._type
        self._active = True
        self._subscriber: rospy.Subscriber | None = rospy.Subscriber(topic, cls, self._receive)

    def wait(self, count: int = 1, timeout: float = 5.0) -> list[Message]:
        """Wait until `count` messages are stored, and return the first `count` messages.

        Raises NothingHeard when fewer than `count` messages are stored after `timeout` s.
        """
        deadline = time.monotonic() + timeout
        with self._arrived:
            # On some platforms, a signal cannot interrupt a long wait for a lock. Each wait is therefore
            # short.
            while len(self.messages) < count and (rest := deadline - time.monotonic()) > 0:
                self._arrived.wait(min(rest, 0.5))
            if len(self.messages) < count:
                raise NothingHeard(self._too_few(count, timeout))
            return list(self.messages)[:count]

    def stop(self, *, unregister: bool = True) -> None:
        """Unsubscribe; the stored messages are not deleted.

        A second call has no effect. Raises MasterUnreachable or MasterSilent when the master does not answer.
        After stop(), no further messages are stored, even if stop() raises an error.
        """
        self._active = False
        subscriber, self._subscriber = self._subscriber, None
        if subscriber is not None and unregister:
            MasterClient(master_uri()).pid()
            subscriber.unregister()

    def renew(self) -> None:
        """Subscribe again after a restart of rospy, unless this subscription was stopped."""
        if self._subscriber is not None:
            self._subscriber = rospy.Subscriber(self.name, self._cls, self._receive)

    def __enter__(self) -> Subscription:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.name} of type {self.type}, {'subscribed' if self._subscriber else 'stopped'}>"

    def _receive(self, message: Message) -> None:
        if not self._active:
            return
        with self._arrived:
            self.messages.append(message)
            self.count += 1
            self._arrived.notify_all()
        if self._callback is not None:
            try:
                self._callback(message)
            except Exception as error:  # noqa: BLE001 -- stored, because rospy would print it below any cell
                self.errors.append(error)

    def _too_few(self, count: int, timeout: float) -> str:
        publishers = self._subscriber.get_num_connections() if self._subscriber else 0
        why = f"{publishers} publishers are connected" if publishers else "no publisher is connected"
        return (
            f"{self.name}: received {len(self.messages)} of {count} messages within {timeout:g} s, and "
            f"{why}. Check the publishers and their type ({self.type}) with `rostopic info {self.name}`."
        )
