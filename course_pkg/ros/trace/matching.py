"""Combine the records of several nodes: match handlers with requests, and callbacks with messages.

The publisher and the subscriber count the messages of a connection separately. Two records describe one
message if they have the same topic or service, the same connection, and the same number. A later connection
may use the same ports again. Records are therefore not matched if there are several possible matches, or if
the times of the records contradict each other.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from course_pkg.ros.trace.recording import (
    CALLBACK,
    ERROR,
    HANDLER,
    NOBODY,
    PUBLISH,
    REQUEST,
    RESPONSE,
    Event,
    SpanData,
)

# The tuple contains the service or topic, the connection, and the number of the message on it.
TransferKey = tuple[str, str, int]


@dataclass(frozen=True)
class NodeRecord:
    """The record of one process; one node can have several records if its process was restarted."""

    node: str
    process: int
    spans: Sequence[SpanData]


class Span:
    """An action, such as a call, that a process has recorded; match_events() converts it to an Event."""

    def __init__(self, record: NodeRecord, data: SpanData) -> None:
        self.node = record.node
        self.process = record.process
        self.data = data
        self.kind = data["kind"]
        self.start = data["start"]
        self.call = data["call"]
        self.transfers: list[TransferKey] = [
            (data["name"], connection, number) for connection, number, _ in data["transfers"]
        ]
        self.exchange: Exchange | None = None


class Exchange:
    """A call with its handler, or a message with its callbacks, or one unmatched span."""

    def __init__(self, kind: str, first: Span) -> None:
        self.kind = kind
        self.spans: list[Span] = []
        self.add(first)

    def add(self, span: Span) -> None:
        """Add a span, and set its `exchange`."""
        self.spans.append(span)
        span.exchange = self

    def started(self, kind: str) -> float | None:
        """Return the time when the first span of the kind `kind` began, or None if there is none."""
        return next((each.start for each in self.spans if each.kind == kind), None)

    @property
    def finished(self) -> float | None:
        """Return the time when the caller received a response or an error, or None if both are missing."""
        ends = (self.started(kind) for kind in (RESPONSE, ERROR))
        return next((end for end in ends if end is not None), None)


def match_events(records: Iterable[NodeRecord], start: float, end: float) -> tuple[Event, ...]:
    """Return the events of all nodes between two values of time.monotonic(), sorted by their start."""
    spans = [Span(record, data) for record in records for data in record.spans if _overlaps(data, start, end)]
    spans.sort(key=lambda each: each.start)
    _match_calls(spans)
    _match_messages(spans)
    keys = _keys(spans)
    threads = _thread_names(spans)
    return tuple(_event(each, keys, threads, start, end) for each in spans)


def _overlaps(data: SpanData, start: float, end: float) -> bool:
    return data["start"] <= end and (data["end"] is None or data["end"] >= start)


def _match_calls(spans: Sequence[Span]) -> None:
    calls: dict[tuple[int, int], Exchange] = {}
    callers: dict[TransferKey, set[Exchange]] = defaultdict(set)
    for each in (each for each in spans if each.call):
        call = calls.get((each.process, each.call))
        if call is None:
            call = calls[each.process, each.call] = Exchange("call", each)
        else:
            call.add(each)
        for transfer in each.transfers:
            callers[transfer].add(call)
    handlers = _by_transfer(each for each in spans if each.kind == HANDLER)
    for transfer, found in handlers.items():
        if len(found) == 1 and len(callers[transfer]) == 1:
            (call,) = callers[transfer]
            if _within(found[0], call):
                call.add(found[0])


def _within(handler: Span, call: Exchange) -> bool:
    """Return whether the handler began during the call."""
    requested, finished = call.started(REQUEST), call.finished
    return (requested is None or requested <= handler.start) and (
        finished is None or handler.start <= finished
    )


def _match_messages(spans: Sequence[Span]) -> None:
    published = _by_transfer(each for each in spans if each.kind == PUBLISH)
    for each in (each for each in spans if each.kind == PUBLISH):
        Exchange("message", each)
    for each in (each for each in spans if each.kind == CALLBACK):
        sources = published.get(each.transfers[0], []) if each.transfers else []
        if len(sources) == 1 and sources[0].start <= each.start and sources[0].exchange is not None:
            sources[0].exchange.add(each)


def _by_transfer(spans: Iterable[Span]) -> dict[TransferKey, list[Span]]:
    found: dict[TransferKey, list[Span]] = defaultdict(list)
    for each in spans:
        for transfer in each.transfers:
            found[transfer].append(each)
    return found


def _keys(spans: Iterable[Span]) -> dict[Exchange, str]:
    """Return a key for each exchange, such as "call 2" for the second call."""
    numbers = {"call": 0, "message": 0}
    keys: dict[Exchange, str] = {}
    for each in spans:
        exchange = each.exchange or Exchange("message" if each.kind == CALLBACK else "call", each)
        if exchange not in keys:
            numbers[exchange.kind] += 1
            keys[exchange] = f"{exchange.kind} {numbers[exchange.kind]}"
    return keys


def _thread_names(spans: Iterable[Span]) -> dict[tuple[str, int, str], str]:
    """Return a name for each thread; add a number to the name if several threads have the same name."""
    named: dict[tuple[str, str], list[int]] = defaultdict(list)
    threads: dict[tuple[str, int, str], str] = {}
    for each in spans:
        name, ident = each.data["thread"]
        idents = named[each.node, name]
        if ident not in idents:
            idents.append(ident)
            threads[each.node, ident, name] = name if len(idents) == 1 else f"{name} ({len(idents)})"
    return threads


def _event(
    span: Span,
    keys: Mapping[Exchange, str],
    threads: Mapping[tuple[str, int, str], str],
    start: float,
    end: float,
) -> Event:
    data = span.data
    name, ident = data["thread"]
    ended = data["end"] is not None and data["end"] <= end
    peers = sorted({peer for _, _, peer in data["transfers"]}) if span.kind == PUBLISH else [data["peer"]]
    assert span.exchange is not None
    return Event(
        kind=span.kind,
        node=span.node,
        name=data["name"],
        start=span.start - start,
        end=data["end"] - start if data["end"] is not None and ended else None,
        peer=", ".join(peers),
        key=keys[span.exchange],
        thread=threads[span.node, ident, name],
        note=_note(data, ended),
    )


def _note(data: SpanData, ended: bool) -> str:
    """Return the note on a span, such as an error message; a running span may have no note yet."""
    if data["kind"] != PUBLISH:
        return data["note"] if ended else ""
    if not ended:
        return data["note"]
    expected, sent = data["connections"], len(data["transfers"])
    if not expected:
        return NOBODY
    if sent < expected:
        return f"sent to {sent} of {expected} subscribers; the other copies were dropped or are in a queue"
    return data["note"]
