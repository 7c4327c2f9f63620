"""A check's subscription to a student's topic; it stores each message with its time of arrival.

The subscription accepts any type (`rospy.AnyMsg`), so the check can report a publisher with a wrong type. The
type is in the connection header: http://wiki.ros.org/ROS/TCPROS.
"""

from __future__ import annotations

import difflib
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import genpy
import rospy

from course_pkg.checking.assertions import Hints, Results, hint_for
from course_pkg.checking.peers.node import Node
from course_pkg.checking.plain_values import Fields, Message, ServiceClass, Value, fields_of
from course_pkg.waiting import wait_until

# At most this number of messages is stored. A loop without a sleep may publish many more messages.
KEPT = 20_000


@dataclass(frozen=True)
class Arrival:
    """One message: its `fields` as plain data, and its time of arrival `at` (time.monotonic())."""

    fields: Fields
    at: float  # The message arrived at this time in s.
    by: str  # The node with this name published the message.
    latched: bool  # The value is true if the publisher sends its last message to later subscribers.


class Subscription:
    """A subscription of the check; it ends with the check or with `leave()`."""

    def __init__(self, results: Results, node: Node, topic: str, kind: ServiceClass, label: str) -> None:
        self.name = topic
        self.kind = str(kind._type)
        self.count = 0  # This number also counts the messages that are not stored.
        self._results, self._node = results, node
        self._label = label  # The titles of assertions show this text for the topic.
        self._cls = kind
        self._arrivals: list[Arrival] = []
        self._others: deque[str] = deque(maxlen=1)  # This is the type of the last message with a wrong type.
        self._arrived = threading.Condition()

    @property
    def arrivals(self) -> tuple[Arrival, ...]:
        """The messages that have arrived, the oldest message first."""
        return tuple(self._arrivals)

    def wait(self, count: int = 1, within: float = 5.0) -> list[Arrival]:
        """Return the first `count` messages.

        If fewer messages have arrived after the time `within` (s), return only these messages.
        """
        self.until(lambda arrivals: len(arrivals) >= count, within)
        return self._arrivals[:count]

    def until(self, condition: Callable[[Sequence[Arrival]], bool], within: float = 5.0) -> bool:
        """Wait until the function `condition` accepts the received messages, and return True.

        If this takes longer than the time `within` (s), return False.
        """
        with self._arrived:
            return self._arrived.wait_for(lambda: condition(self._arrivals), within)

    def during(self, seconds: float) -> list[Arrival]:
        """Wait for the time `seconds` (s), and return the messages that arrived in this time."""
        with self._arrived:
            before = len(self._arrivals)
            self._arrived.wait_for(lambda: False, seconds)
            return self._arrivals[before:]

    def published(self, *, hints: Hints = (), within: float = 2.0) -> None:
        """Assert that a node publishes on the topic with the right type, and wait for the connection.

        The actual value for `hints` is "no publisher", or the name of a wrong type.
        """
        assertion = f"{self._label} is published with the type {self.kind}"
        found = wait_until(self._found, within)
        if found != self.kind:
            actual = found or "no publisher"
            hint = hint_for(hints, actual) or self._what_to_do(found)
            self._results.fails(assertion, expected="a publisher", actual=actual, hint=hint)
        self._results.passes(assertion)

    def publishers(self) -> tuple[str, ...]:
        """Return the nodes that are registered at the master as publishers of the topic."""
        return self._node.master.system_state().publishers.get(self.name, ())

    def leave(self) -> None:
        """Unsubscribe; the stored messages are not deleted."""
        self._subscriber.unregister()

    def __enter__(self) -> Subscription:
        self._subscriber = rospy.Subscriber(self.name, rospy.AnyMsg, self._receive, tcp_nodelay=True)
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    def _receive(self, raw: Message) -> None:
        at, header = time.monotonic(), raw._connection_header
        if header.get("md5sum") != self._cls._md5sum:
            self._others.append(_type_in(header, self._cls))
            return
        try:
            fields = fields_of(self._cls().deserialize(raw._buff))
        except genpy.DeserializationError:
            return
        arrival = Arrival(fields, at, header.get("callerid", ""), header.get("latching") == "1")
        with self._arrived:
            self.count += 1
            if len(self._arrivals) < KEPT:
                self._arrivals.append(arrival)
            self._arrived.notify_all()

    def _found(self) -> str:
        """Return the type of the topic's publisher, or "" if no publisher is connected."""
        if self._arrivals:
            return self.kind
        headers = map(_header_of, self._subscriber.impl.connections)
        kinds = [_type_in(header, self._cls) for header in headers]
        return next((kind for kind in kinds if kind), "") or next(iter(self._others), "")

    def _what_to_do(self, found: str) -> str:
        if found:
            return (
                f"The topic has the wrong type. Publish the topic with the type in the exercise: {self.kind}."
            )
        others = [name for name in self._node.master.system_state().publishers if name != "/rosout"]
        if alike := difflib.get_close_matches(self.name, others, n=1):
            return (
                f"The graph contains a topic with a similar name, {alike[0]}. Compare this name "
                "letter by letter with the name in the exercise."
            )
        return (
            "No node publishes this topic. Run the cell that publishes this topic, and run it "
            "again after each restart of the kernel."
        )


def rate(arrivals: Sequence[Arrival]) -> float:
    """Return the number of messages per second; return 0.0 if there are fewer than two messages."""
    if len(arrivals) < 2 or arrivals[-1].at <= arrivals[0].at:
        return 0.0
    return (len(arrivals) - 1) / (arrivals[-1].at - arrivals[0].at)


def _header_of(connection: Value) -> dict[str, str]:
    """Return the header of a publisher's connection, or an empty dict before the headers are exchanged."""
    md5sum = getattr(connection, "md5sum", None)  # rospy sets `md5sum` last, so `type` exists, too.
    return {"type": connection.type, "md5sum": md5sum} if md5sum else {}


def _type_in(header: Mapping[str, str], kind: ServiceClass) -> str:
    """Return the type in a connection header, or "" if the header is empty."""
    name = str(header.get("type") or "")
    another = name == kind._type and header.get("md5sum") != kind._md5sum
    return f"{name} with another definition" if another else name
