"""Computes the rates of topics from message counts, and lists the callers of services."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from math import floor, log10, sqrt
from typing import TYPE_CHECKING, TypedDict

from course_pkg.panels.graph.picture import Kind, Picture, Shape, namespaces

if TYPE_CHECKING:
    from course_pkg.ros.trace.activity import Activity, Traffic

# The rate is measured over at most `LONG` seconds. A change of the rate is noticed after `SHORT` seconds.
LONG, SHORT = 30.0, 3.9
LEAST = 1.5  # A rate is reliable only if it was measured over at least this time (s).
LATE = 0.05  # A busy node may report its counts with a delay of up to this time in s.
SHOWN = 12  # The page lists at most this many connections of a topic, or callers of a service.
UNCONNECTED = "not connected: check that both nodes use the same type"

Key = tuple[str, str, str, int]
Pair = list[str]  # A pair contains a label and its value.


class Caller(TypedDict):
    """A node that called a service, with the number of its calls.

    `last` is the time of the latest call (s since the epoch), and `running` is the number of unfinished
    calls. `gone` is True if the node has left the graph.
    """

    node: str
    calls: int
    last: float
    running: int
    gone: bool


class CallLine(TypedDict):
    """A line to draw from the shape of a caller to the shape of a service."""

    tail: str
    head: str
    last: float
    running: int


class ActivityState(TypedDict, total=False):
    """The rates and calls that the page shows; each key is the key of a Shape, such as "topic /chatter".

    `notes` are the short texts below the names of topics, with at most 12 letters each. `details` contains
    pairs of a label and a value. `callers` lists the nodes that called each service. If a server does not
    report its callers, its service has no entry in `callers`. `calls` contains the lines to draw.
    """

    notes: dict[str, str]
    details: dict[str, list[Pair]]
    callers: dict[str, list[Caller]]
    calls: list[CallLine]


class RateMeter:
    """Measures the message rate of one connection between a publisher and a subscriber."""

    def __init__(self) -> None:
        self._counts: deque[tuple[float, int]] = deque()
        self._shown: float | None = None

    def read(self, at: float, messages: int) -> None:
        """Add a count: `messages` is the number of messages on the connection until the time `at` (s)."""
        if self._counts and messages < self._counts[-1][1]:
            # The count is smaller than the previous count. The publisher was restarted, and its new
            # connection has the same id.
            self._counts.clear()
        self._counts.append((at, messages))
        while at - self._counts[0][0] > LONG:
            self._counts.popleft()
        self._forget_former_rate()
        self._settle()

    @property
    def rate(self) -> float | None:
        """The rounded number of messages per second, or None if there are too few counts."""
        return self._shown

    def _forget_former_rate(self) -> None:
        """If the rate has changed, remove all counts that are older than the change."""
        at, messages = self._counts[-1]
        recent = [each for each in self._counts if at - each[0] >= SHORT]
        if len(recent) < 2:
            return
        (first, sent), (middle, until) = recent[0], recent[-1]
        expected = (until - sent) / (middle - first) * (at - middle)
        stopped = messages == until and expected >= 3
        if stopped or abs(messages - until - expected) > 2 + 3 * sqrt(expected):
            self._counts = deque(each for each in self._counts if each[0] >= middle)

    def _settle(self) -> None:
        (since, before), (at, messages) = self._counts[0], self._counts[-1]
        if at - since < LEAST:
            return
        rate = (messages - before) / (at - since)
        tolerance = (1 + LATE * rate) / (at - since)
        holds = self._shown is not None and abs(self._shown - rate) <= tolerance + 0.01 * rate
        if not holds or bool(rate) != bool(self._shown):
            self._shown = plainest(rate, tolerance)


def plainest(rate: float, tolerance: float) -> float:
    """Round the rate to as few significant digits (1 to 3) as possible.

    The error is at most `tolerance`.
    """
    if rate <= 0:
        return 0.0
    for digits in range(3):
        rounded = round(rate, digits - floor(log10(rate)))
        if abs(rounded - rate) <= tolerance:
            return rounded
    return rounded


def rate_text(rate: float) -> str:
    """Return a rate as text, such as "10 Hz"."""
    if 0 < rate < 0.1:
        return "< 0.1 Hz"
    return f"{rate:.3g} Hz" if rate < 999.5 else f"{rate / 1000:.3g} kHz"


class Rates:
    """Measures the rates of all connections of a graph."""

    def __init__(self) -> None:
        self._meters: dict[Key, RateMeter] = {}

    def read(self, activity: Activity) -> None:
        """Update the rate of each connection with its number of messages at the time `activity.at`.

        Connections that are not in `activity` have ended and are removed.
        """
        meters = {_key(each): self._meters.get(_key(each)) or RateMeter() for each in activity.traffic}
        for each in activity.traffic:
            meters[_key(each)].read(activity.at, each.messages)
        self._meters = meters

    def of(self, carried: Traffic) -> float | None:
        """Return the rate of a connection (Hz), or None if the rate is not known yet."""
        meter = self._meters.get(_key(carried))
        return meter.rate if meter else None


def _key(carried: Traffic) -> Key:
    return (carried.topic, carried.publisher, carried.subscriber, carried.connection)


class _Ends:
    """Two dicts with the publishers and subscribers of each topic; the keys are the keys of the topics."""

    def __init__(self, picture: Picture) -> None:
        self.publishers: dict[str, list[str]] = defaultdict(list)
        self.subscribers: dict[str, list[str]] = defaultdict(list)
        for line in picture.lines:
            self.publishers[line.head].append(line.tail.partition(" ")[2])
            self.subscribers[line.tail].append(line.head.partition(" ")[2])


class GraphActivity:
    """Converts repeated counts of messages and calls into an ActivityState for the page."""

    def __init__(self) -> None:
        self.seen: Activity | None = None
        self._rates = Rates()
        self._carried: dict[str, list[Traffic]] = defaultdict(list)

    def read(self, activity: Activity) -> None:
        """Add the counts in `activity`, which were all read at the same time."""
        self.seen = activity
        self._rates.read(activity)
        self._carried.clear()
        for each in activity.traffic:
            self._carried[each.topic].append(each)

    def state(self, picture: Picture, alive: Container[str], box: Callable[[str], str]) -> ActivityState:
        """Return the ActivityState for the page.

        `alive` contains the names of all nodes on the graph, including nodes that the panel does not show.
        The function `box` returns the key of the visible shape for the key of any shape. A shape in a folded
        namespace is not visible; its visible shape is the box of the namespace.
        """
        ends = _Ends(picture)
        topics = {each.key: self._topic(each, ends) for each in picture.shapes if each.kind is Kind.TOPIC}
        callers = {each.key: self._callers(each, alive) for each in self._reporting(picture)}
        return {
            "notes": {key: note for key, (note, _) in topics.items()},
            "details": {key: details for key, (_, details) in topics.items()} | _spaces(picture, topics),
            "callers": callers,
            "calls": list(_calls(callers, box)) if callers else [],
        }

    def _topic(self, topic: Shape, ends: _Ends) -> tuple[str, list[Pair]]:
        publishers, subscribers = ends.publishers[topic.key], ends.subscribers[topic.key]
        if not publishers:
            return "no publisher", [["rate", "no publisher, so there are no messages"]]
        if not subscribers:
            return "not received", [["rate", "no subscriber, so nothing is sent"]]
        if self.seen is None:
            return "", []
        carried = self._carried[topic.name]
        details = [
            [f"{publisher} → {subscriber}", self._connection(publisher, subscriber, carried)]
            for publisher in publishers
            for subscriber in subscribers
        ]
        note = self._note(publishers, [each for each in carried if each.subscriber in subscribers])
        return note, _shortened(details, "connections")

    def _note(self, publishers: list[str], carried: list[Traffic]) -> str:
        """Return the rate of a topic as text.

        The rate of a topic is the sum of the rates of its publishers. The rate of a publisher is the highest
        rate of its connections.
        """
        assert self.seen is not None
        if self.seen.silent.intersection(publishers):
            return "not counted"
        if not carried:
            return "unconnected"
        rates = {each: rate for each in carried if (rate := self._rates.of(each)) is not None}
        fastest = [
            max(rate for each, rate in rates.items() if each.publisher == name) for name in _senders(rates)
        ]
        return rate_text(sum(fastest)) if fastest else ""

    def _connection(self, publisher: str, subscriber: str, carried: Iterable[Traffic]) -> str:
        assert self.seen is not None
        if publisher in self.seen.silent:
            return "the publisher does not report its message counts"
        ours = [each for each in carried if (each.publisher, each.subscriber) == (publisher, subscriber)]
        if not ours:
            return UNCONNECTED
        rate, count = self._rates.of(ours[-1]), ours[-1].messages
        sent = f"{count} message{'' if count == 1 else 's'} since it connected"
        return rate_text(rate) if rate else sent if rate is None else f"0 Hz, {sent}"

    def _reporting(self, picture: Picture) -> Iterator[Shape]:
        known = self.seen.callers if self.seen else {}
        return (each for each in picture.shapes if each.kind is Kind.SERVICE and each.name in known)

    def _callers(self, service: Shape, alive: Container[str]) -> list[Caller]:
        assert self.seen is not None
        return [
            {
                "node": each.node,
                "calls": each.calls,
                "last": round(each.last, 1),
                "running": each.running,
                "gone": each.node not in alive,
            }
            for each in self.seen.callers[service.name][:SHOWN]
        ]


def _spaces(picture: Picture, topics: Mapping[str, tuple[str, list[Pair]]]) -> dict[str, list[Pair]]:
    """Return the topics of each namespace, with their rates."""
    return {
        f"{Kind.SPACE.value} {name}": _shortened(
            [[key.split(" ", 1)[1], topics[key][0] or "…"] for key in sorted(members) if key in topics],
            "topics",
        )
        for name, members in namespaces(picture).items()
    }


def _senders(carried: Iterable[Traffic]) -> list[str]:
    return sorted({each.publisher for each in carried})


def _calls(callers: dict[str, list[Caller]], box: Callable[[str], str]) -> Iterator[CallLine]:
    """Yield a line for each caller that is on the graph, from its shape to the shape of the service."""
    latest: dict[tuple[str, str], Caller] = {}
    for service, each in ((service, each) for service, who in callers.items() for each in who):
        ends = box(f"{Kind.NODE.value} {each['node']}"), box(service)
        if not each["gone"] and ends[0] != ends[1] and latest.get(ends, each)["last"] <= each["last"]:
            latest[ends] = each
    for (tail, head), each in sorted(latest.items(), key=lambda item: item[0]):
        yield {"tail": tail, "head": head, "last": each["last"], "running": each["running"]}


def _shortened(details: list[Pair], what: str) -> list[Pair]:
    if len(details) <= SHOWN:
        return details
    return [*details[: SHOWN - 1], ["…", f"{len(details) - SHOWN + 1} more {what}"]]
