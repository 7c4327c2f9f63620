"""What a student's topic says, as a check hears it: each message with the time of its arrival.

It listens for any type (`rospy.AnyMsg`). A subscriber of one type never hears of a publisher of another,
and a check has to be able to say so. http://wiki.ros.org/ROS/TCPROS, fields of the connection header.
"""

from __future__ import annotations

import difflib
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import genpy
import rospy

from course_pkg.examiner.ledger import Hints, Ledger, hint_for
from course_pkg.examiner.node import Node
from course_pkg.examiner.plain import Message, Plain, ServiceClass, plain
from course_pkg.examiner.waiting import until

KEPT = 20_000  # messages: a student's loop may lack its sleep


@dataclass(frozen=True)
class Arrival:
    """One message: its `fields` as plain data, `at` what time.monotonic() it came, and from whom."""

    fields: dict[str, Plain]
    at: float  # s
    by: str  # the node that published it
    latched: bool  # whether its publisher keeps the last message for those who come later


class Hearing:
    """A topic that the check listens to, from `Exam.hear` until the check is over or `leave()` is called."""

    def __init__(self, ledger: Ledger, node: Node, topic: str, kind: ServiceClass, label: str) -> None:
        self.name = topic
        self.kind = str(kind._type)
        self.count = 0  # of all messages of its type, also those beyond the first KEPT
        self._ledger, self._node, self._label = ledger, node, label  # the label is how rules call it
        self._cls = kind
        self._arrivals: list[Arrival] = []
        self._others: deque[str] = deque(maxlen=1)  # a wrong type that was heard
        self._came = threading.Condition()

    @property
    def arrivals(self) -> tuple[Arrival, ...]:
        """The messages so far, oldest first."""
        return tuple(self._arrivals)

    def wait(self, count: int = 1, within: float = 5.0) -> list[Arrival]:
        """Return the first `count` messages as soon as there are so many; fewer, when `within` s are over."""
        self.until(lambda arrivals: len(arrivals) >= count, within)
        return self._arrivals[:count]

    def until(self, condition: Callable[[Sequence[Arrival]], bool], within: float = 5.0) -> bool:
        """Wait until `condition` holds for the messages so far, at most `within` s; say whether it does."""
        with self._came:
            return self._came.wait_for(lambda: condition(self._arrivals), within)

    def during(self, seconds: float) -> list[Arrival]:
        """Listen for `seconds`, and return what came in that time."""
        with self._came:
            before = len(self._arrivals)
            self._came.wait_for(lambda: False, seconds)
            return self._arrivals[before:]

    def published(self, *, hints: Hints = (), within: float = 2.0) -> None:
        """Hold that somebody publishes the topic, and of its type; return when what is said is heard.

        `hints` recognise what was seen: "nobody who publishes it", or another type.
        """
        rule = f"{self._label} is published as {self.kind}"
        found = until(self._found, within)
        if found != self.kind:
            words = found or "nobody who publishes it"
            hint = hint_for(hints, words) or self._what_to_do(found)
            self._ledger.fails(rule, expected="a publisher", seen=words, hint=hint)
        self._ledger.passes(rule)

    def publishers(self) -> tuple[str, ...]:
        """Return the nodes that publish the topic, as the master has it."""
        return self._node.master.system_state().publishers.get(self.name, ())

    def leave(self) -> None:
        """Stop listening; what was heard stays."""
        self._subscriber.unregister()

    def __enter__(self) -> Hearing:
        self._subscriber = rospy.Subscriber(self.name, rospy.AnyMsg, self._hear, tcp_nodelay=True)
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    def _hear(self, raw: Message) -> None:
        at, header = time.monotonic(), raw._connection_header
        if header.get("md5sum") != self._cls._md5sum:
            self._others.append(_told(header, self._cls))
            return
        try:
            fields = plain(self._cls().deserialize(raw._buff))
        except genpy.DeserializationError:
            return
        arrival = Arrival(fields, at, header.get("callerid", ""), header.get("latching") == "1")
        with self._came:
            self.count += 1
            if len(self._arrivals) < KEPT:
                self._arrivals.append(arrival)
            self._came.notify_all()

    def _found(self) -> str:
        """Return the type in which the topic is published and heard, or "" as long as it is not."""
        if self._arrivals:
            return self.kind
        told = [_told(_said(connection), self._cls) for connection in self._subscriber.impl.connections]
        return next((kind for kind in told if kind), "") or next(iter(self._others), "")

    def _what_to_do(self, found: str) -> str:
        if found:
            return f"Publish it with the type that the exercise names: {self.kind}."
        others = [name for name in self._node.master.system_state().publishers if name != "/rosout"]
        if alike := difflib.get_close_matches(self.name, others, n=1):
            return f"There is {alike[0]}: compare the names letter by letter."
        return "Run the cell that publishes it, also after each restart of the kernel."


def rate(arrivals: Sequence[Arrival]) -> float:
    """Return how many messages came a second; 0.0 where fewer than two say nothing about it."""
    if len(arrivals) < 2 or arrivals[-1].at <= arrivals[0].at:
        return 0.0
    return (len(arrivals) - 1) / (arrivals[-1].at - arrivals[0].at)


def _said(connection: Any) -> dict[str, str]:  # noqa: ANN401 -- rospy has no types
    """Return what a publisher has said of itself; rospy lists a connection before it stands."""
    md5sum = getattr(connection, "md5sum", None)  # the last that rospy fills in
    return {"type": connection.type, "md5sum": md5sum} if md5sum else {}


def _told(said: Mapping[str, str], kind: ServiceClass) -> str:
    """Word the type that a publisher says it has; "" as long as it has said nothing."""
    name = str(said.get("type") or "")
    another = name == kind._type and said.get("md5sum") != kind._md5sum
    return f"{name} of another definition" if another else name
