"""How many messages of a publisher were sent, wait or were dropped, for each subscriber.

With a queue_size, rospy puts a message into a queue for each subscriber, and a thread writes the queue to the
connection. A full queue drops its oldest message silently, so the queue is replaced by one that counts. A
message counts as sent when it is written to the connection: a publisher cannot know what a slow subscriber
drops after that.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from typing import SupportsIndex

import rospy
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_pubsub import QueuedConnection


@dataclass(frozen=True)
class Delivery:
    """How many messages for the node `peer` were sent, still wait, and were dropped from a full queue."""

    peer: str
    sent: int
    waiting: int
    dropped: int


class Deliveries(rospy.SubscribeListener):
    """The deliveries of one publisher, including those to subscribers that have disconnected."""

    def __init__(self, publisher: rospy.Publisher) -> None:
        super().__init__()
        self._impl = publisher.impl
        self._lock = threading.RLock()
        self._connections: list[TCPROSTransport | QueuedConnection] = []
        self._disconnected = Delivery("", 0, 0, 0)
        self._impl.add_subscriber_listener(self)
        self.update()

    def update(self) -> None:
        """Begin to count on new connections, and add the counts of closed connections to their sum."""
        with self._lock:
            connected = list(self._impl.connections or ())
            for connection in connected:
                if connection not in self._connections:
                    _count(connection)
            for delivery in [_delivery(each) for each in self._connections if each not in connected]:
                self._disconnected = replace(
                    self._disconnected,
                    sent=self._disconnected.sent + delivery.sent,
                    dropped=self._disconnected.dropped + delivery.dropped,
                )
            self._connections = connected

    def current(self) -> tuple[Delivery, ...]:
        """Return the deliveries to the subscribers that are connected."""
        return self._all()[:-1]

    @property
    def dropped(self) -> int:
        """How many messages the queues have dropped, counted once for each subscriber that missed one."""
        return sum(each.dropped for each in self._all())

    @property
    def sent(self) -> int:
        """How many messages were sent, counted once for each subscriber."""
        return sum(each.sent for each in self._all())

    def peer_subscribe(self, _topic: str, _publish: object, _publish_to_one: object) -> None:
        """Count for a subscriber that has just connected; rospy sends it a latched message after this."""
        self.update()

    def _all(self) -> tuple[Delivery, ...]:
        """Return a delivery for each subscriber, and at the end one for all that have disconnected."""
        self.update()
        with self._lock:
            return (*map(_delivery, self._connections), self._disconnected)


class _CountedQueue(list[bytes]):
    """Messages that wait for one connection; rospy drops the oldest by `del queue[0]`."""

    def __init__(self, messages: list[bytes], connection: _CountedConnection) -> None:
        super().__init__(messages)
        self._connection = connection

    def append(self, message: bytes) -> None:
        super().append(message)
        self._connection.queued += 1

    def __delitem__(self, index: SupportsIndex | slice) -> None:
        super().__delitem__(index)
        self._connection.dropped += 1


class _CountedConnection(QueuedConnection):
    """A connection whose queue counts; rospy assigns an empty list to it after it has taken all messages."""

    queued = 0
    dropped = 0

    @property
    def _queue(self) -> _CountedQueue:
        queue: _CountedQueue = self.__dict__["counted_queue"]
        return queue

    @_queue.setter
    def _queue(self, messages: list[bytes]) -> None:
        self.__dict__["counted_queue"] = _CountedQueue(messages, self)


def _count(connection: TCPROSTransport | QueuedConnection) -> None:
    """Replace the queue of a connection; without a queue_size it has no queue, and writes directly."""
    if type(connection) is not QueuedConnection:
        return
    with connection._lock:
        state = vars(connection)
        waiting = state.pop("_queue")
        state["queued"] = connection.stat_num_msg + len(waiting)
        connection.__class__ = _CountedConnection
        connection._queue = waiting


def _delivery(connection: TCPROSTransport | QueuedConnection) -> Delivery:
    sent = connection.stat_num_msg
    if not isinstance(connection, _CountedConnection):
        return Delivery(connection.endpoint_id, sent, 0, 0)
    waiting = max(0, connection.queued - connection.dropped - sent)
    return Delivery(connection.endpoint_id, sent, waiting, connection.dropped)
