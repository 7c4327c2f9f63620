"""A subscription to whatever a topic carries, of any type: counted, timed, the last messages kept as bytes.

rospy takes a message apart only where somebody wants to see it, so that a fast topic stays cheap.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import rospy

from course_pkg.graph.station.curve import Curve
from course_pkg.graph.station.pace import Pace

KEPT = 10  # messages
LONGEST = 16_384  # bytes of a message that is kept

Extract = Callable[[bytes], float]


@dataclass(frozen=True)
class Sound:
    """A message: `number` since the beginning, `at` (s of time.monotonic()), its source, and its bytes.

    `body` is empty for one that is too long to be kept; `size` is its length in bytes.
    """

    number: int
    at: float
    peer: str
    type: str
    md5: str
    size: int
    body: bytes


@dataclass(frozen=True)
class Source:
    """A publisher that is connected: its node, and the type that it says it sends."""

    node: str
    type: str
    md5: str


class Ears:
    """Listens to `topic`."""

    def __init__(self, topic: str) -> None:
        self.count = 0
        self.pace = Pace()
        self.curve = Curve()
        self._extract: Extract | None = None
        self._md5 = ""
        self._turn = threading.Lock()
        self._news: deque[Sound] = deque(maxlen=KEPT)
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._hear, tcp_nodelay=True)

    def plot(self, md5: str, extract: Extract | None) -> None:
        """Draw a curve of what `extract` finds in messages of the type with this MD5; a new curve."""
        self._md5, self._extract, self.curve = md5, extract, Curve()

    def news(self) -> list[Sound]:
        """Return the last messages since this was asked before, oldest first."""
        with self._turn:
            news = list(self._news)
            self._news.clear()
        return news

    def sources(self) -> list[Source]:
        """Return the publishers that are connected."""
        connections = self._subscriber.impl.connections
        return [Source(str(each.callerid_pub), str(each.type), str(each.md5sum)) for each in connections]

    def _hear(self, message: Any) -> None:  # noqa: ANN401 -- rospy has no types
        at = time.monotonic()
        body, header = message._buff, message._connection_header
        self.pace.beat(at)
        with self._turn:
            self.count += 1
            about = header["callerid"], header["type"], header["md5sum"], len(body)
            self._news.append(Sound(self.count, at, *about, body if len(body) <= LONGEST else b""))
        if self._extract and header["md5sum"] == self._md5:
            self.curve.add(at, self._extract(body))
