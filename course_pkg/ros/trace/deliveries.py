"""Count the sent, waiting and dropped messages of a publisher, for each subscriber.

For a publisher with a queue_size, rospy creates a queue for each subscriber. A thread sends the messages of a
queue. When a queue is full, rospy drops the oldest message without an error message. This module replaces the
queue with a queue that counts the messages.

A message counts as sent when it is written to the connection. A slow subscriber may drop the message later;
the publisher cannot detect this.
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
    """The numbers of sent, waiting and dropped messages for the node `peer`."""

    peer: str
    sent: int
    waiting: int
    dropped: int


class Deliveries(rospy.SubscribeListener):
    """The deliveries of one publisher, including deliveries to disconnected subscribers."""

    def __init__(self, publisher: rospy.Publisher) -> None:
        super().__init__()
        self._impl = publisher.impl
        self._lock = threading.RLock()
        self._connections: list[TCPROSTransport | QueuedConnection] = []
        self._disconnected = Delivery("", 0, 0, 0)
        self._impl.add_subscriber_listener(self)
        self.update()

    def update(self) -> None:
        """Count the messages of new connections, and add the counts of closed connections to a sum."""
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
        """Return the deliveries to the connected subscribers."""
        return self._all()[:-1]

    @property
    def dropped(self) -> int:
        """The number of messages dropped from full queues, for all subscribers together."""
        return sum(each.dropped for each in self._all())

    @property
    def sent(self) -> int:
        """The number of sent messages; a message that was sent to two subscribers counts twice."""
        return sum(each.sent for each in self._all())

    def peer_subscribe(self, _topic: str, _publish: object, _publish_to_one: object) -> None:
        """Start counting the messages for a new subscriber, before rospy sends the latched message."""
        self.update()

    def _all(self) -> tuple[Delivery, ...]:
        """Return one Delivery for each connected subscriber, and then the sum of all closed connections."""
        self.update()
        with self._lock:
            return (*map(_delivery, self._connections), self._disconnected)


class _CountedQueue(list[bytes]):
    """The message queue of one connection; it counts the messages that rospy drops with `del queue[0]`."""

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
    """A connection with a counting queue.

    Before rospy sends the messages in the queue, it assigns a new list to `_queue`. This class replaces the
    new list with a counting queue, too.
    """

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
    """Replace the queue of a connection with a counting queue.

    A connection without a queue_size has no queue.
    """
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
