"""Converts reports of the topic process into texts about the latest messages and the publisher."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypedDict

from course_pkg.errors import CourseError
from course_pkg.panels.forms.form import Row, compact, rows, summary
from course_pkg.ros.topic.connections import ANY
from course_pkg.ros.topic.reports import Connections, Figures, MessageReport, Peer, PublisherReport, Source
from course_pkg.types import MessageType

SHORT = 8  # The first digits of an MD5 sum, up to this number, are enough to distinguish two types.
KEPT = 10  # The panel lists at most this many messages.
LINES = 40  # The table of the latest message has at most this many rows.

FindType = Callable[[str], MessageType]


class PublisherState(PublisherReport, total=False):
    """A report about the publisher, with a sentence for the page and the name of the panel's node."""

    words: str
    own: str


class SubscriptionState(TypedDict):
    """The number of received messages, and statistics about the times between two messages."""

    count: int
    statistics: Figures


class ShownMessage(TypedDict):
    """A received message for the page: its values in one line, or the reason why no values can be shown."""

    number: int
    ago: float
    peer: str
    line: str
    understood: bool


class MessageLog:
    """The latest messages of a topic, each in one line, and the last message as a table."""

    def __init__(self) -> None:
        self._entries: deque[ShownMessage] = deque(maxlen=KEPT)
        self.latest: list[Row] = []

    @property
    def entries(self) -> list[ShownMessage]:
        """The messages, with the latest message first."""
        return list(self._entries)

    def add(self, messages: Iterable[MessageReport], kind: MessageType | None) -> None:
        """Add new messages; in `messages`, the oldest message comes first."""
        for each in messages:
            lines = _rows(each, kind)
            self._entries.appendleft(
                {
                    "number": each["number"],
                    "ago": each["ago"],
                    "peer": each["peer"],
                    "line": _remark(each, kind) if lines is None else summary(lines) or "no fields",
                    "understood": lines is not None,
                }
            )
            if lines is not None:
                self.latest = lines


def _rows(message: MessageReport, kind: MessageType | None) -> list[Row] | None:
    if kind is None or message["texts"] is None or message["md5"] != kind.md5:
        return None
    return rows(kind.fields, compact(kind.fields, message["texts"]), LINES)


def _remark(message: MessageReport, kind: MessageType | None) -> str:
    size = f"{message['size']:,} bytes"
    if kind is None or message["md5"] == kind.md5:
        return f"{size}, too long to be shown here" if kind else size
    return f"another type: {message['type']}, {size}"


def published(report: PublisherReport, own: str) -> str:
    """Return a sentence about the last published message.

    `own` is the name of the panel's node; this node also subscribes to the topic.
    """
    count = report.get("published", 0)
    if not count:
        return "Nothing is published yet. The first message creates the publisher."
    if not report["advertised"]:
        return "The publisher was unregistered. The next message creates a new publisher."
    if report["rate"]:
        return _rate(report)
    peers = [_peer(each["peer"], own) for each in report["deliveries"]]
    if report["reached"]:
        same = len(peers) == report["reached"]
        return (
            f"Message {count} was sent to {_all(peers) if same else _count(report['reached'], 'subscriber')}."
        )
    if not report["latch"]:
        return f"Message {count} reached no subscriber, because no subscriber was connected at that time."
    if peers:
        return f"Message {count} was stored until the first connection, and was then sent to {_all(peers)}."
    return (
        f"Message {count} has reached no subscriber yet. The message is latched, so the next "
        "subscriber gets it."
    )


def _rate(report: PublisherReport) -> str:
    measured = report["statistics"].get("rate")
    kept = f" (measured: {measured:.4g} Hz)" if measured else ""
    skipped = (
        f" {_count(report['skipped'], 'message')} could not be sent in time." if report["skipped"] else ""
    )
    return f"Publishing at {report['rate']:g} Hz{kept}.{skipped}"


def mismatches(kind: MessageType, connections: Connections, own: str, find: FindType) -> list[str]:
    """Return a sentence for each node that uses another type than `kind`.

    rospy does not report that the types differ.
    """
    sources = {source["node"]: source for source in connections.get("sources", ())}
    return [
        *_of_publishers(kind, connections.get("publishers", ()), sources, own, find),
        *_of_subscribers(kind, connections.get("subscribers", ()), own, find),
    ]


def _of_publishers(
    kind: MessageType,
    publishers: Iterable[Peer],
    sources: Mapping[str, Source],
    own: str,
    find: FindType,
) -> Iterator[str]:
    for each in publishers:
        node, source = each["node"], sources.get(each["node"])
        name = source["type"] if source else each["type"]
        md5 = source["md5"] if source else _md5(name, find)
        if node != own and _differs(kind, name, md5):
            yield (
                f"{node} publishes {_type(name, md5)}, but this panel uses "
                f"{_type(kind.name, kind.md5)}. A subscriber with the panel's type gets none "
                "of these messages, and it gets no error message."
            )


def _of_subscribers(
    kind: MessageType, subscribers: Iterable[Peer], own: str, find: FindType
) -> Iterator[str]:
    for each in subscribers:
        node, name = each["node"], each["type"]
        md5 = _md5(name, find)
        if node != own and _differs(kind, name, md5):
            yield (
                f"{node} subscribes to {_type(name, md5)}, but this panel uses "
                f"{_type(kind.name, kind.md5)}. This node gets none of the panel's messages, "
                "and it gets no error message."
            )


def _differs(kind: MessageType, name: str, md5: str) -> bool:
    if not name or name == ANY:
        return False
    return md5 != kind.md5 if md5 else name != kind.name


def _md5(name: str, find: FindType) -> str:
    """Return the MD5 of the type `name`, or "" if the function `find` does not find the type."""
    try:
        return find(name).md5 if name and name != ANY else ""
    except CourseError:
        return ""


def _type(name: str, md5: str) -> str:
    return f"{name} (MD5 {md5[:SHORT]}…)" if md5 else name


def _peer(node: str, own: str) -> str:
    return "this panel" if node == own else node


def _all(names: list[str]) -> str:
    """Return the names as one text, such as "a, b and c"."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def _count(number: int, what: str) -> str:
    return f"1 {what}" if number == 1 else f"{number} {what}s"
