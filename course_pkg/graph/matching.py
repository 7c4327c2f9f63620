"""What several nodes have recorded, put together: which request a handler works on, what a callback got.

Nothing is guessed. Both ends of a connection number what goes over it, so the same connection, name and
number are the same request or message. A port may be used again by a later connection; where that leaves
more than one possibility, or where the times contradict, the two sides stay apart.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from course_pkg.graph.events import CALLBACK, ERROR, HANDLER, NOBODY, PUBLISH, REQUEST, RESPONSE, Event

Told = Mapping[str, Any]  # a mark as its process tells it; course_pkg.graph.trace.Mark
WireName = tuple[str, str, int]  # service or topic, connection, number on it


@dataclass(frozen=True)
class Record:
    """What one process has told of what it did; two may have been the same node, one after the other."""

    node: str
    process: int
    marks: Sequence[Told]


class Seen:
    """A mark of a process, on the way to become an event."""

    def __init__(self, record: Record, told: Told) -> None:
        self.node = record.node
        self.process = record.process
        self.told = told
        self.kind = str(told["kind"])
        self.start = float(told["start"])
        self.call = int(told["call"])
        self.wires: list[WireName] = [
            (told["name"], connection, number) for connection, number, _ in told["wires"]
        ]
        self.exchange: Exchange | None = None


class Exchange:
    """A call with its handler, or a message with its callbacks; or one of the two sides alone."""

    def __init__(self, of: str, first: Seen) -> None:
        self.of = of
        self.seen: list[Seen] = []
        self.take(first)

    def take(self, seen: Seen) -> None:
        """Count a mark as a part of it."""
        self.seen.append(seen)
        seen.exchange = self

    def started(self, kind: str) -> float | None:
        """Return when its first part of a kind began, or None."""
        return next((each.start for each in self.seen if each.kind == kind), None)

    @property
    def settled(self) -> float | None:
        """Return when the caller knew how the call went, or None."""
        ends = (self.started(kind) for kind in (RESPONSE, ERROR))
        return next((end for end in ends if end is not None), None)


def matched(records: Iterable[Record], start: float, end: float) -> tuple[Event, ...]:
    """Return the events of all nodes between two times (s of time.monotonic()), sorted by their start."""
    seen = [Seen(record, told) for record in records for told in record.marks if _touches(told, start, end)]
    seen.sort(key=lambda each: each.start)
    _gather_calls(seen)
    _gather_messages(seen)
    keys = _keys(seen)
    threads = _threads(seen)
    return tuple(_event(each, keys, threads, start, end) for each in seen)


def _touches(told: Told, start: float, end: float) -> bool:
    return bool(told["start"] <= end and (told["end"] is None or told["end"] >= start))


def _gather_calls(seen: Sequence[Seen]) -> None:
    calls: dict[tuple[int, int], Exchange] = {}
    on_wire: dict[WireName, set[Exchange]] = defaultdict(set)
    for each in (each for each in seen if each.call):
        call = calls.get((each.process, each.call))
        if call is None:
            call = calls[each.process, each.call] = Exchange("call", each)
        else:
            call.take(each)
        for wire in each.wires:
            on_wire[wire].add(call)
    handlers = _by_wire(each for each in seen if each.kind == HANDLER)
    for wire, found in handlers.items():
        callers = on_wire[wire]
        if len(found) == 1 and len(callers) == 1 and _within(found[0], next(iter(callers))):
            next(iter(callers)).take(found[0])


def _within(handler: Seen, call: Exchange) -> bool:
    """Say whether the handler began after the request was begun, and before the caller was through."""
    requested, settled = call.started(REQUEST), call.settled
    return (requested is None or requested <= handler.start) and (settled is None or handler.start <= settled)


def _gather_messages(seen: Sequence[Seen]) -> None:
    published = _by_wire(each for each in seen if each.kind == PUBLISH)
    for each in (each for each in seen if each.kind == PUBLISH):
        Exchange("message", each)
    for each in (each for each in seen if each.kind == CALLBACK):
        sources = published.get(each.wires[0], []) if each.wires else []
        if len(sources) == 1 and sources[0].start <= each.start and sources[0].exchange is not None:
            sources[0].exchange.take(each)


def _by_wire(seen: Iterable[Seen]) -> dict[WireName, list[Seen]]:
    found: dict[WireName, list[Seen]] = defaultdict(list)
    for each in seen:
        for wire in each.wires:
            found[wire].append(each)
    return found


def _keys(seen: Iterable[Seen]) -> dict[Exchange, str]:
    """Name the exchanges in the order in which they began; who was matched with nothing is one of its own."""
    numbers = {"call": 0, "message": 0}
    keys: dict[Exchange, str] = {}
    for each in seen:
        exchange = each.exchange or Exchange("message" if each.kind == CALLBACK else "call", each)
        if exchange not in keys:
            numbers[exchange.of] += 1
            keys[exchange] = f"{exchange.of} {numbers[exchange.of]}"
    return keys


def _threads(seen: Iterable[Seen]) -> dict[tuple[str, int, str], str]:
    """Name each thread of each node; two may have the same name, such as those of one topic's connections."""
    named: dict[tuple[str, str], list[int]] = defaultdict(list)
    threads: dict[tuple[str, int, str], str] = {}
    for each in seen:
        name, ident = each.told["thread"]
        idents = named[each.node, name]
        if ident not in idents:
            idents.append(ident)
            threads[each.node, ident, name] = name if len(idents) == 1 else f"{name} ({len(idents)})"
    return threads


def _event(
    seen: Seen,
    keys: Mapping[Exchange, str],
    threads: Mapping[tuple[str, int, str], str],
    start: float,
    end: float,
) -> Event:
    told = seen.told
    name, ident = told["thread"]
    over = told["end"] is not None and told["end"] <= end
    peers = sorted({peer for _, _, peer in told["wires"]}) if seen.kind == PUBLISH else [told["peer"]]
    assert seen.exchange is not None
    return Event(
        kind=seen.kind,
        node=seen.node,
        name=told["name"],
        start=seen.start - start,
        end=told["end"] - start if over else None,
        peer=", ".join(peers),
        key=keys[seen.exchange],
        thread=threads[seen.node, ident, name],
        note=_note(told, over),
    )


def _note(told: Told, over: bool) -> str:
    """Return what is said of it in words; how something ended is not known as long as it has not."""
    if told["kind"] != PUBLISH:
        return str(told["note"]) if over else ""
    if not over:
        return str(told["note"])
    asked, sent = told["asked"], len(told["wires"])
    if not asked:
        return NOBODY
    if sent < asked:
        return f"sent to {sent} of {asked}: what is missing was dropped from a queue, or is still in it"
    return str(told["note"])
