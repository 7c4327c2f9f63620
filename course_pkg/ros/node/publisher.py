"""A publisher that counts the messages that it sends and drops."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import rospy

from course_pkg.errors import PublisherStopped
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.trace.deliveries import Deliveries, Delivery

if TYPE_CHECKING:
    from course_pkg.types import MessageClass


class Publisher:
    """A publisher that counts its messages.

    `published` counts all messages; `unheard` counts the messages that were published without a subscriber.
    If `latch` is true, each subscriber that connects later receives the last message. Each subscriber has a
    queue for up to `queue_size` messages; 0 means no limit.
    """

    def __init__(self, topic: str, cls: MessageClass, *, queue_size: int = 10, latch: bool = False) -> None:
        self.name = str(rospy.resolve_name(topic))
        self.type = cls._type
        self.queue_size = queue_size
        self.latch = latch
        self.published = 0
        self.unheard = 0
        self._lock = threading.Lock()
        self._publisher: rospy.Publisher | None = rospy.Publisher(
            self.name, cls, queue_size=queue_size, latch=latch
        )
        self._deliveries = Deliveries(self._publisher)

    def publish(self, *args: object, **fields: object) -> None:
        """Publish a message; pass one message object, or its fields by position or by name.

        Raises PublisherStopped if the publisher was stopped.
        """
        with self._lock:
            if self._publisher is None:
                raise PublisherStopped(f"{self.name}: this publisher was stopped. Advertise the topic again.")
            self._deliveries.update()
            alone = not self._publisher.get_num_connections()
            self._publisher.publish(*args, **fields)
            self.published += 1
            self.unheard += alone

    @property
    def advertised(self) -> bool:
        """Whether this publisher can publish; false after stop()."""
        return self._publisher is not None

    @property
    def deliveries(self) -> tuple[Delivery, ...]:
        """The numbers of sent, waiting and dropped messages, for each connected subscriber."""
        return self._deliveries.current()

    @property
    def sent(self) -> int:
        """The number of sent messages; a message that was sent to two subscribers counts twice."""
        return self._deliveries.sent

    @property
    def dropped(self) -> int:
        """The number of messages dropped from full queues, for all subscribers together."""
        return self._deliveries.dropped

    def stop(self) -> None:
        """Stop publishing and unregister the topic; the counts do not change.

        A second call has no effect. Raises MasterUnreachable or MasterSilent when the master does not answer.
        The publisher is stopped even if stop() raises an error.
        """
        with self._lock:
            publisher, self._publisher = self._publisher, None
        if publisher is not None:
            MasterClient(master_uri()).pid()
            publisher.unregister()

    def __repr__(self) -> str:
        return f"<{self.name} of type {self.type}, {'published' if self._publisher else 'stopped'}>"
