"""The reports of a topic process as JSON data, which a program can read without ROS."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypedDict

from course_pkg.types import StringTree


class Peer(TypedDict):
    """A node on the topic, with its type ("" if the node does not answer)."""

    node: str
    type: str


class Source(Peer):
    """A publisher that is connected to the topic process.

    The type and the MD5 sum are from the publisher's connection header.
    """

    md5: str


class Connections(TypedDict, total=False):
    """The type that the master stores (or ""), the nodes on the topic, and the connected publishers."""

    type: str
    publishers: list[Peer]
    subscribers: list[Peer]
    sources: list[Source]


class Figures(TypedDict, total=False):
    """The rate (1/s), the jitter (s), the longest gap (s), and the number of gaps between messages."""

    rate: float
    jitter: float
    longest: float
    gaps: int


class DeliveryReport(TypedDict):
    """The numbers of sent, waiting and dropped messages for one subscriber."""

    peer: str
    sent: int
    waiting: int
    dropped: int


class PublisherReport(TypedDict, total=False):
    """The state of the publisher. `rate` is the requested rate in 1/s, or 0 without a timer.

    `statistics` is the measured rate. `reached` is the number of subscribers to which the latest message was
    sent. All other counts have the same meaning as in the class Publisher.
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
    """A received message.

    `ago` is the time in s between the message and the report. `texts` is None if the values of the message
    cannot be displayed.
    """

    number: int
    ago: float
    peer: str
    type: str
    md5: str
    size: int
    texts: Mapping[str, StringTree] | None


class Curve(TypedDict):
    """Recent points [time in s since the process started, value] of a number, and the count of all values."""

    points: list[list[float]]
    count: int
    left_out: int


class Report(TypedDict, total=False):
    """A report; it contains only the values that have changed since the previous report.

    `trouble` is an error message if the process cannot reach the master, and "" otherwise. `node` is the name
    of the process's node. `count` is the number of received messages, `statistics` contains their rate, and
    `messages` contains the new messages.
    """

    trouble: str
    node: str
    connections: Connections
    publisher: PublisherReport
    count: int
    statistics: Figures
    messages: list[MessageReport]
    curve: Curve
