"""What a timeline draws, as plain data: events in columns of numbers, on the rows of their nodes.

A page keeps it whole, so it is bounded: of more than 4,000 events the calls come first, then messages in the
order of time, and what is left out is said.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from course_pkg.graph.events import (
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
from course_pkg.panels.timeline.rows import rows_of
from course_pkg.panels.timeline.waits import waits_of

if TYPE_CHECKING:
    from course_pkg.graph import Recording

MOST = 4000  # events; some 200 kB in a saved page
KINDS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER, PUBLISH, CALLBACK)
TICKS = 1e6  # of the state's time in a second: it counts whole microseconds
OPEN = -1  # the end of what had none; nothing else ends before the recording began

State = dict[str, Any]


class Words:
    """Texts by number, each once."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {"": 0}

    def number(self, text: str) -> int:
        """Return the text's number."""
        return self._numbers.setdefault(text, len(self._numbers))

    @property
    def texts(self) -> list[str]:
        """All texts, by number."""
        return list(self._numbers)


def state(recording: Recording) -> State:
    """Return all that the page needs; times are in µs from the start of the recording."""
    events, left_out = _kept(recording.events)
    lanes = list(dict.fromkeys(event.node for event in events))
    rows, depths = rows_of(events)
    words = Words()
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
            "name": [words.number(event.name) for event in events],
            "peer": [words.number(event.peer) for event in events],
            "key": [words.number(event.key) for event in events],
            "thread": [words.number(event.thread) for event in events],
            "note": [words.number(event.note) for event in events],
        },
        "words": words.texts,
        "arrows": arrows(events),
        "waits": waits_of(recording),
        "idle": [node for node in recording.nodes if node not in lanes],
        "unrecorded": [[node, why] for node, why in sorted(recording.unrecorded.items())],
        "notes": [*recording.notes, *left_out],
    }


def arrows(events: Sequence[Event]) -> list[list[int]]:
    """Return [from, to] for each request, response and message that both ends have on record."""
    parts: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
    for number, event in enumerate(events):
        parts[event.key][event.kind].append(number)
    found = [arrow for part in parts.values() for arrow in _arrows(part, events)]
    return sorted(found, key=lambda arrow: events[arrow[0]].start)


def _arrows(part: dict[str, list[int]], events: Sequence[Event]) -> list[list[int]]:
    """Return the arrows of one exchange.

    An answer goes from the end of the handler to the caller, also if it says no; a caller that has given up
    got none.
    """
    found = [[message, callback] for message in part[PUBLISH] for callback in part[CALLBACK]]
    for handler in part[HANDLER]:
        # The request itself may have been sent before the recording began.
        found += [[caller, handler] for caller in (part[REQUEST] or part[WAIT])[:1]]
        answers = [number for number in (*part[RESPONSE], *part[ERROR]) if events[number].peer]
        found += [[handler, answer] for answer in answers if events[handler].end is not None]
    return found


def _kept(events: Sequence[Event]) -> tuple[list[Event], list[str]]:
    """Return the events that are drawn, and a sentence about those that are left out."""
    if len(events) <= MOST:
        return list(events), []
    calls = [event for event in events if event.kind in OF_CALLS][:MOST]
    room = MOST - len(calls)
    messages = [event for event in events if event.kind not in OF_CALLS]
    kept = sorted([*calls, *messages[:room]], key=lambda event: event.start)
    of_messages = room < len(messages)
    first = messages[room].start if of_messages else events[MOST].start
    what = "messages and callbacks" if of_messages else "events"
    count = len(events) - len(kept)
    return kept, [f"Drawn are {MOST:,} events: {count:,} {what} from {first:.4g} s on are left out."]


def _count(events: Sequence[Event], rows: Sequence[int], node: str) -> int:
    return 1 + max(row for row, event in zip(rows, events, strict=True) if event.node == node)


def _ticks(seconds: float) -> int:
    return round(seconds * TICKS)
