"""What becomes of the messages of a publisher, subscriber by subscriber, as rospy really handles them.

With a queue_size, rospy puts a message into a queue for each subscriber, which a thread empties into the
connection; a queue that is full throws its oldest message away and tells nobody. So the queue is made to
count. What is sent lies in the connection: what a slow subscriber throws away afterwards, no publisher hears.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from typing import Any, SupportsIndex

import rospy
from rospy.impl.tcpros_pubsub import QueuedConnection


@dataclass(frozen=True)
class Delivery:
    """How many messages for the node `peer` were sent, still wait, and were dropped for lack of room."""

    peer: str
    sent: int
    waiting: int
    dropped: int


class Deliveries(rospy.SubscribeListener):
    """The deliveries of one publisher, also to subscribers that have gone since."""

    def __init__(self, publisher: rospy.Publisher) -> None:
        super().__init__()
        self._impl = publisher.impl
        self._turn = threading.RLock()
        self._connections: list[Any] = []  # rospy has no types
        self._gone = Delivery("", 0, 0, 0)
        self._impl.add_subscriber_listener(self)
        self.watch()

    def watch(self) -> None:
        """Count from now on what goes over connections that are new, and add up those that are gone."""
        with self._turn:
            connected = list(self._impl.connections or ())
            for connection in connected:
                if connection not in self._connections:
                    _count(connection)
            for delivery in [_delivery(each) for each in self._connections if each not in connected]:
                self._gone = replace(
                    self._gone,
                    sent=self._gone.sent + delivery.sent,
                    dropped=self._gone.dropped + delivery.dropped,
                )
            self._connections = connected

    def of_now(self) -> tuple[Delivery, ...]:
        """Return the deliveries to the subscribers that are connected."""
        return self._all()[:-1]

    @property
    def dropped(self) -> int:
        """How many messages the queues have thrown away, counted once for each subscriber that missed one."""
        return sum(each.dropped for each in self._all())

    @property
    def sent(self) -> int:
        """How many messages were sent, counted once for each subscriber."""
        return sum(each.sent for each in self._all())

    def peer_subscribe(self, _topic: str, _publish: object, _publish_to_one: object) -> None:
        """Count for a subscriber that has just connected; rospy sends it a latched message after this."""
        self.watch()

    def _all(self) -> tuple[Delivery, ...]:
        """Return a delivery for each subscriber, and at the end one for all that are gone."""
        self.watch()
        with self._turn:
            return (*map(_delivery, self._connections), self._gone)


class _CountedQueue(list[bytes]):
    """Messages that wait for one connection; rospy throws the oldest away by `del queue[0]`."""

    def __init__(self, messages: list[bytes], connection: _CountedConnection) -> None:
        super().__init__(messages)
        self._connection = connection

    def append(self, message: bytes) -> None:
        super().append(message)
        self._connection.handed += 1

    def __delitem__(self, index: SupportsIndex | slice) -> None:
        super().__delitem__(index)
        self._connection.dropped += 1


class _CountedConnection(QueuedConnection):
    """A connection whose queue counts; rospy gives it an empty list when it has taken all messages out."""

    handed = 0
    dropped = 0

    @property
    def _queue(self) -> _CountedQueue:
        queue: _CountedQueue = self.__dict__["counted_queue"]
        return queue

    @_queue.setter
    def _queue(self, messages: list[bytes]) -> None:
        self.__dict__["counted_queue"] = _CountedQueue(messages, self)


def _count(connection: Any) -> None:  # noqa: ANN401
    """Have a connection count; without a queue_size it has no queue, and writes at once."""
    if type(connection) is not QueuedConnection:
        return
    with connection._lock:
        state = vars(connection)
        waiting = state.pop("_queue")
        state["handed"] = connection.stat_num_msg + len(waiting)
        connection.__class__ = _CountedConnection
        connection._queue = waiting


def _delivery(connection: Any) -> Delivery:  # noqa: ANN401
    sent = connection.stat_num_msg
    if not isinstance(connection, _CountedConnection):
        return Delivery(connection.endpoint_id, sent, 0, 0)
    waiting = max(0, connection.handed - connection.dropped - sent)
    return Delivery(connection.endpoint_id, sent, waiting, connection.dropped)
