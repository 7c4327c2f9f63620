"""What a topic process reports, as JSON data: no ROS is needed to read it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypedDict

from course_pkg.types import StringTree


class Peer(TypedDict):
    """A node on the topic, with its type ("" if it does not answer)."""

    node: str
    type: str


class Source(Peer):
    """A publisher that is connected to the topic process, with the type that it has sent in its header."""

    md5: str


class Connections(TypedDict, total=False):
    """The type that the master knows ("" for none), the nodes on the topic, and the connected publishers."""

    type: str
    publishers: list[Peer]
    subscribers: list[Peer]
    sources: list[Source]


class Figures(TypedDict, total=False):
    """The rate (1/s), the jitter and the longest gap (s) of `gaps` gaps between messages."""

    rate: float
    jitter: float
    longest: float
    gaps: int


class DeliveryReport(TypedDict):
    """The messages to one subscriber: sent, waiting in the queue, and dropped."""

    peer: str
    sent: int
    waiting: int
    dropped: int


class PublisherReport(TypedDict, total=False):
    """What is published: `rate` in 1/s (0: none), `statistics` as measured; the last part is Publisher's.

    `reached` is the number of subscribers that the latest message went to.
    """

    problem: str
    rate: float
    skipped: int
    statistics: Figures
    advertised: bool
    latch: bool
    queue: int
    published: int
    unheard: int
    sent: int
    dropped: int
    reached: int | None
    deliveries: list[DeliveryReport]


class MessageReport(TypedDict):
    """A message that came `ago` s before the report; `texts` is None if its values cannot be shown."""

    number: int
    ago: float
    peer: str
    type: str
    md5: str
    size: int
    texts: Mapping[str, StringTree] | None


class Curve(TypedDict):
    """The recent values of a number: points as [s from the start, value], and how many values came."""

    points: list[list[float]]
    count: int
    left_out: int


class Report(TypedDict, total=False):
    """The parts of a report that have changed.

    `trouble` is why the process cannot see the graph, "" when it can. `node` is its own name on the graph.
    `count` received messages have come, with the rate `statistics`; `messages` are the new ones.
    """

    trouble: str
    node: str
    connections: Connections
    publisher: PublisherReport
    count: int
    statistics: Figures
    messages: list[MessageReport]
    curve: Curve
