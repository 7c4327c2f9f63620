"""A subscription to a topic of any type.

A subscription counts the messages, and stores their times and the bytes of the last messages. A message is
deserialised only if a panel shows its values, because deserialising all messages of a fast topic takes too
long.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import rospy

from course_pkg.ros.node.type_lookup import Message
from course_pkg.ros.topic.reports import Source
from course_pkg.ros.topic.statistics import DownsampledSeries, RateStatistics

CAPACITY = 10  # At most this number of messages is stored: the last ones.
LONGEST = 16_384  # A message body with more bytes than this number is not stored.

Extract = Callable[[bytes], float]


@dataclass(frozen=True)
class ReceivedMessage:
    """A message, its publisher, and its bytes.

    The first message has the `number` 1, and `at` is a value of time.monotonic().

    `size` is the length of the message in bytes. `body` is empty if the message is too long to be stored.
    """

    number: int
    at: float
    peer: str
    type: str
    md5: str
    size: int
    body: bytes


class TopicSubscription:
    """Receives and counts the messages of the topic `topic`, and stores the last messages."""

    def __init__(self, topic: str) -> None:
        self.count = 0
        self.rate = RateStatistics()
        self.series = DownsampledSeries()
        self._extract: Extract | None = None
        self._md5 = ""
        self._lock = threading.Lock()
        self._received: deque[ReceivedMessage] = deque(maxlen=CAPACITY)
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._receive, tcp_nodelay=True)

    def plot(self, md5: str, extract: Extract | None) -> None:
        """Start a new series; `extract` reads a value from each message whose type has the MD5 sum `md5`."""
        self._md5, self._extract, self.series = md5, extract, DownsampledSeries()

    def new_messages(self) -> list[ReceivedMessage]:
        """Return the messages since the previous call, the oldest first; at most 10 messages are stored."""
        with self._lock:
            received = list(self._received)
            self._received.clear()
        return received

    def sources(self) -> list[Source]:
        """Return the connected publishers."""
        connections = self._subscriber.impl.connections
        return [
            Source(node=str(each.callerid_pub), type=str(each.type), md5=str(each.md5sum))
            for each in connections
        ]

    def _receive(self, message: Message) -> None:
        at = time.monotonic()
        body, header = message._buff, message._connection_header
        self.rate.beat(at)
        with self._lock:
            self.count += 1
            about = header["callerid"], header["type"], header["md5sum"], len(body)
            stored = body if len(body) <= LONGEST else b""
            self._received.append(ReceivedMessage(self.count, at, *about, stored))
        if self._extract and header["md5sum"] == self._md5:
            self.series.add(at, self._extract(body))
