"""What happens on the graph, in words for the page: rates of topics, and who called a service lately."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from course_pkg.panels.graph.folding import namespaces
from course_pkg.panels.graph.picture import Kind, Picture, Shape
from course_pkg.panels.graph.rates import Rates, words

if TYPE_CHECKING:
    from course_pkg.graph.activity import Activity, Carried

State = dict[str, Any]
Pair = list[str]
SHOWN = 12  # connections of a topic, or callers of a service
UNCONNECTED = "not connected: do both have the same type?"


class _Ends:
    """Who publishes and who subscribes to each topic of a picture, by its key."""

    def __init__(self, picture: Picture) -> None:
        self.publishers: dict[str, list[str]] = defaultdict(list)
        self.subscribers: dict[str, list[str]] = defaultdict(list)
        for line in picture.lines:
            self.publishers[line.head].append(line.tail.partition(" ")[2])
            self.subscribers[line.tail].append(line.head.partition(" ")[2])


class Doings:
    """Turns what was counted at one time after the other into words."""

    def __init__(self) -> None:
        self.seen: Activity | None = None
        self._rates = Rates()
        self._carried: dict[str, list[Carried]] = defaultdict(list)

    def read(self, activity: Activity) -> None:
        """Take in the counts of one time."""
        self.seen = activity
        self._rates.read(activity)
        self._carried.clear()
        for each in activity.carried:
            self._carried[each.topic].append(each)

    def told(self, picture: Picture, alive: Container[str], box: Callable[[str], str]) -> State:
        """Return what the page shows, by the key of the shape it belongs to.

        `notes` are the few words under a topic's name (at most 12 letters), `details` pairs of label and
        value, `callers` who called a service (missing: its server does not tell), `calls` the lines to draw
        for that. `alive` are the nodes of the graph, also those that are not shown. `box` returns where a
        shape is drawn: as itself, or as the folded namespace that it is in.
        """
        ends = _Ends(picture)
        topics = {each.key: self._topic(each, ends) for each in picture.shapes if each.kind is Kind.TOPIC}
        callers = {each.key: self._callers(each, alive) for each in self._telling(picture)}
        return {
            "notes": {key: note for key, (note, _) in topics.items()},
            "details": {key: details for key, (_, details) in topics.items()} | _spaces(picture, topics),
            "callers": callers,
            "calls": list(_calls(callers, box)) if callers else [],
        }

    def _topic(self, topic: Shape, ends: _Ends) -> tuple[str, list[Pair]]:
        publishers, subscribers = ends.publishers[topic.key], ends.subscribers[topic.key]
        if not publishers:
            return "no publisher", [["rate", "no publisher, nothing comes"]]
        if not subscribers:
            return "no listener", [["rate", "no listener, nothing is sent"]]
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

    def _note(self, publishers: list[str], carried: list[Carried]) -> str:
        """Return the rate of a topic: what goes to the listener who gets most, of all publishers together."""
        assert self.seen is not None
        if self.seen.mute.intersection(publishers):
            return "not counted"
        if not carried:
            return "unconnected"
        rates = {each: rate for each in carried if (rate := self._rates.of(each)) is not None}
        heard = [
            max(rate for each, rate in rates.items() if each.publisher == name) for name in _senders(rates)
        ]
        return words(sum(heard)) if heard else ""

    def _connection(self, publisher: str, subscriber: str, carried: Iterable[Carried]) -> str:
        assert self.seen is not None
        if publisher in self.seen.mute:
            return "its publisher does not tell what it sends"
        ours = [each for each in carried if (each.publisher, each.subscriber) == (publisher, subscriber)]
        if not ours:
            return UNCONNECTED
        rate, count = self._rates.of(ours[-1]), ours[-1].messages
        sent = f"{count} message{'' if count == 1 else 's'} since it connected"
        return words(rate) if rate else sent if rate is None else f"0 Hz, {sent}"

    def _telling(self, picture: Picture) -> Iterator[Shape]:
        known = self.seen.callers if self.seen else {}
        return (each for each in picture.shapes if each.kind is Kind.SERVICE and each.name in known)

    def _callers(self, service: Shape, alive: Container[str]) -> list[State]:
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
    """Return for each namespace what its topics carry."""
    return {
        f"{Kind.SPACE.value} {name}": _shortened(
            [[key.split(" ", 1)[1], topics[key][0] or "…"] for key in sorted(members) if key in topics],
            "topics",
        )
        for name, members in namespaces(picture).items()
    }


def _senders(carried: Iterable[Carried]) -> list[str]:
    return sorted({each.publisher for each in carried})


def _calls(callers: dict[str, list[State]], box: Callable[[str], str]) -> Iterator[State]:
    """Yield a line for each caller that is there: from its shape to that of the service."""
    latest: dict[tuple[str, str], State] = {}
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
