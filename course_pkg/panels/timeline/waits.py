"""Who waited for whom, added up; and who did not, because nobody waits for a message."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Any

from course_pkg.graph.events import BLOCKED, CALLBACK, ERROR, MASTER, NOBODY, PUBLISH, Event

if TYPE_CHECKING:
    from course_pkg.graph import Recording

State = dict[str, Any]


def waits_of(recording: Recording) -> State:
    """Return `calls`, one entry for each caller, service and server, and `streams`, one for each publisher.

    Times are in s, those who waited longest come first. A wait that had not ended counts to the end of the
    recording.
    """
    calls: dict[tuple[str, str], list[Event]] = defaultdict(list)
    streams: dict[tuple[str, str], list[Event]] = defaultdict(list)
    hearers: dict[str, set[str]] = defaultdict(set)
    for event in recording.events:
        if event.kind in BLOCKED or event.kind == ERROR:
            calls[event.node, event.name].append(event)
        elif event.kind == PUBLISH:
            streams[event.node, event.name].append(event)
        elif event.kind == CALLBACK:
            hearers[event.key].add(event.node)
    waits = [_wait(*who, events, recording.length) for who, events in calls.items()]
    return {
        "calls": sorted(waits, key=lambda wait: -float(wait["blocked"])),
        "streams": [_stream(*who, events, hearers) for who, events in streams.items()],
    }


def _wait(node: str, service: str, events: list[Event], length: float) -> State:
    spans: dict[str, float] = defaultdict(float)
    for event in events:
        end = length if event.end is None else event.end
        spans[event.key] += end - max(event.start, 0.0)
    return {
        "node": node,
        "service": service,
        "servers": sorted({event.peer for event in events} - {MASTER, ""}),
        "calls": len(spans),
        "blocked": sum(spans.values()),
        "longest": max(spans.values()),
        "open": sum(event.open for event in events),
        "failed": sum(event.kind == ERROR for event in events),
    }


def _stream(node: str, topic: str, events: list[Event], hearers: dict[str, set[str]]) -> State:
    heard = {hearer for event in events for hearer in hearers[event.key]}
    alone = sum(event.note == NOBODY for event in events)
    return {"node": node, "topic": topic, "published": len(events), "alone": alone, "heard_by": sorted(heard)}
