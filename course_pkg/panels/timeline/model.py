"""The data of a timeline for the page: one list for each property of the events, and the rows of each node.

A saved page contains all these data, so their size is limited. If a recording has more than 4,000 events, the
data contain the events of calls before messages, up to this limit. A note then tells the reader how many
events are missing.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypedDict

from course_pkg.panels.timeline.waits import Waits, waits_of
from course_pkg.ros.trace.recording import (
    CALLBACK,
    CONNECT,
    ERROR,
    HANDLER,
    LOOKUP,
    OF_CALLS,
    PUBLISH,
    REQUEST,
    RESPONSE,
    WAIT,
    Event,
)

if TYPE_CHECKING:
    from course_pkg.ros import Recording

MOST = 4000  # The data contain at most this many events, which take about 200 kB in a saved page.
KINDS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER, PUBLISH, CALLBACK)
TICKS = 1e6  # The data contain times in whole microseconds; one second has this many microseconds.
# `OPEN` is the end of an event that was not finished.
OPEN = -1


class Lane(TypedDict):
    """A node, and the number of its rows in the timeline."""

    node: str
    rows: int


class Columns(TypedDict):
    """The events, with one list for each property.

    The lists from `name` to `note` contain indices into the list `strings` of TimelineState.
    """

    kind: list[int]
    lane: list[int]
    row: list[int]
    depth: list[int]
    start: list[int]
    end: list[int]
    name: list[int]
    peer: list[int]
    key: list[int]
    thread: list[int]
    note: list[int]


class TimelineState(TypedDict):
    """A recording for the page; times are in µs from the start of the recording.

    `arrows` contains a pair of event indices for each arrow. `idle` contains the nodes without an event.
    `unrecorded` contains the nodes that could not be recorded, each with the reason.
    """

    length: int
    kinds: list[str]
    lanes: list[Lane]
    columns: Columns
    strings: list[str]
    arrows: list[list[int]]
    waits: Waits
    idle: list[str]
    unrecorded: list[list[str]]
    notes: list[str]


class StringTable:
    """A list of different strings; each string has an index."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {"": 0}

    def number(self, text: str) -> int:
        """Return the index of a string; a new string is added to the list."""
        return self._numbers.setdefault(text, len(self._numbers))

    @property
    def strings(self) -> list[str]:
        """All strings, sorted by index."""
        return list(self._numbers)


def state(recording: Recording) -> TimelineState:
    """Return the data of a recording for the page."""
    events, left_out = _kept(recording.events)
    lanes = list(dict.fromkeys(event.node for event in events))
    rows, depths = rows_of(events)
    table = StringTable()
    return {
        "length": _ticks(recording.length),
        "kinds": list(KINDS),
        "lanes": [{"node": node, "rows": _count(events, rows, node)} for node in lanes],
        "columns": {
            "kind": [KINDS.index(event.kind) for event in events],
            "lane": [lanes.index(event.node) for event in events],
            "row": rows,
            "depth": depths,
            "start": [_ticks(event.start) for event in events],
            "end": [OPEN if event.end is None else _ticks(event.end) for event in events],
            "name": [table.number(event.name) for event in events],
            "peer": [table.number(event.peer) for event in events],
            "key": [table.number(event.key) for event in events],
            "thread": [table.number(event.thread) for event in events],
            "note": [table.number(event.note) for event in events],
        },
        "strings": table.strings,
        "arrows": arrows(events),
        "waits": waits_of(recording),
        "idle": [node for node in recording.nodes if node not in lanes],
        "unrecorded": [[node, why] for node, why in sorted(recording.unrecorded.items())],
        "notes": [*recording.notes, *left_out],
    }


@dataclass
class _Thread:
    """The indices of the events of one thread of a node."""

    numbers: list[int] = field(default_factory=list)
    start: float = math.inf
    end: float = -math.inf

    def take(self, number: int, event: Event) -> None:
        self.numbers.append(number)
        self.start = min(self.start, event.start)
        self.end = max(self.end, _end(event))


def rows_of(events: Sequence[Event]) -> tuple[list[int], list[int]]:
    """Return the row and the depth of each event.

    The depth is the number of earlier events in the same thread that still ran when the event began.

    All events of a thread are in one row. Several threads can use the same row, one after another.
    """
    rows, depths = [0] * len(events), [0] * len(events)
    nodes: dict[str, dict[str, _Thread]] = defaultdict(lambda: defaultdict(_Thread))
    for number, event in enumerate(events):
        nodes[event.node][event.thread].take(number, event)
    for threads in nodes.values():
        free: list[float] = []  # The time at which each row becomes free.
        for thread in sorted(threads.values(), key=lambda each: each.start):
            row = next((row for row, end in enumerate(free) if end < thread.start), len(free))
            free[row : row + 1] = [thread.end]
            _place(thread, row, events, rows, depths)
    return rows, depths


def _place(thread: _Thread, row: int, events: Sequence[Event], rows: list[int], depths: list[int]) -> None:
    around: list[float] = []  # The ends of the events that contain the current event.
    for number in sorted(thread.numbers, key=lambda each: (events[each].start, -_end(events[each]))):
        while around and around[-1] <= events[number].start:
            around.pop()
        rows[number], depths[number] = row, len(around)
        around.append(_end(events[number]))


def _end(event: Event) -> float:
    return math.inf if event.end is None else event.end


def arrows(events: Sequence[Event]) -> list[list[int]]:
    """Return a pair of event indices for each request, response and message that was sent and received."""
    parts: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
    for number, event in enumerate(events):
        parts[event.key][event.kind].append(number)
    found = [arrow for part in parts.values() for arrow in _arrows(part, events)]
    return sorted(found, key=lambda arrow: events[arrow[0]].start)


def _arrows(part: dict[str, list[int]], events: Sequence[Event]) -> list[list[int]]:
    """Return the arrows of one call or of one message.

    The arrow of a response or an error goes from the end of the handler to the caller. If the caller did not
    wait any more, the response has no arrow.
    """
    found = [[message, callback] for message in part[PUBLISH] for callback in part[CALLBACK]]
    for handler in part[HANDLER]:
        # If the client sent the request before the recording began, the request's arrow begins at the bar of
        # the client's wait.
        found += [[caller, handler] for caller in (part[REQUEST] or part[WAIT])[:1]]
        answers = [number for number in (*part[RESPONSE], *part[ERROR]) if events[number].peer]
        found += [[handler, answer] for answer in answers if events[handler].end is not None]
    return found


def _kept(events: Sequence[Event]) -> tuple[list[Event], list[str]]:
    """Return the events to draw, and a sentence about the events that are left out."""
    if len(events) <= MOST:
        return list(events), []
    calls = [event for event in events if event.kind in OF_CALLS][:MOST]
    room = MOST - len(calls)
    messages = [event for event in events if event.kind not in OF_CALLS]
    kept = sorted([*calls, *messages[:room]], key=lambda event: event.start)
    messages_left_out = room < len(messages)
    first = messages[room].start if messages_left_out else events[MOST].start
    what = "messages and callbacks" if messages_left_out else "events"
    count = len(events) - len(kept)
    return kept, [
        f"{MOST:,} events are drawn. {count:,} {what} that begin at {first:.4g} s or later are not drawn."
    ]


def _count(events: Sequence[Event], rows: Sequence[int], node: str) -> int:
    return 1 + max(row for row, event in zip(rows, events, strict=True) if event.node == node)


def _ticks(seconds: float) -> int:
    return round(seconds * TICKS)
