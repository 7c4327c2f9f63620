"""The waits in a recording: a caller waits for a server, but a publisher does not wait."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, TypedDict

from course_pkg.ros.trace.recording import BLOCKED, CALLBACK, ERROR, MASTER, NOBODY, PUBLISH, Event

if TYPE_CHECKING:
    from course_pkg.ros import Recording


class Wait(TypedDict):
    """The calls of one node to one service, and the time that the node waited for the responses.

    `blocked` is the total waiting time in s, and `longest` is the longest wait. `open` is the number of
    unfinished calls.
    """

    node: str
    service: str
    servers: list[str]
    calls: int
    blocked: float
    longest: float
    open: int
    failed: int


class Stream(TypedDict):
    """The messages of one node on one topic.

    `alone` is the number of messages that were published without a subscriber.
    """

    node: str
    topic: str
    published: int
    alone: int
    heard_by: list[str]


class Waits(TypedDict):
    """The calls, sorted by their total waiting time (longest first), and the messages on each topic."""

    calls: list[Wait]
    streams: list[Stream]


def waits_of(recording: Recording) -> Waits:
    """Return the waits of a recording.

    An unfinished wait is counted up to the end of the recording.
    """
    calls: dict[tuple[str, str], list[Event]] = defaultdict(list)
    streams: dict[tuple[str, str], list[Event]] = defaultdict(list)
    receivers: dict[str, set[str]] = defaultdict(set)
    for event in recording.events:
        if event.kind in BLOCKED or event.kind == ERROR:
            calls[event.node, event.name].append(event)
        elif event.kind == PUBLISH:
            streams[event.node, event.name].append(event)
        elif event.kind == CALLBACK:
            receivers[event.key].add(event.node)
    waits = [_wait(*who, events, recording.length) for who, events in calls.items()]
    return {
        "calls": sorted(waits, key=lambda wait: -wait["blocked"]),
        "streams": [_stream(*who, events, receivers) for who, events in streams.items()],
    }


def _wait(node: str, service: str, events: list[Event], length: float) -> Wait:
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


def _stream(node: str, topic: str, events: list[Event], receivers: dict[str, set[str]]) -> Stream:
    received = {receiver for event in events for receiver in receivers[event.key]}
    alone = sum(event.note == NOBODY for event in events)
    return {
        "node": node,
        "topic": topic,
        "published": len(events),
        "alone": alone,
        "heard_by": sorted(received),
    }


def timeline_text(recording: Recording) -> str:
    """Return one sentence per line about which node waited for which node, without times.

    The lines about calls come before the lines about messages, and both groups are sorted. Therefore, the
    text is the same in every run with the same events.
    """
    return "\n".join(sentences(waits_of(recording)))


def sentences(waits: Waits) -> list[str]:
    """Return the sentences of timeline_text() for these waits."""
    lines = sorted(_called(each) for each in waits["calls"])
    lines += sorted(_published(each) for each in waits["streams"])
    return lines or ["Nothing was recorded."]


def _called(wait: Wait) -> str:
    servers = " and ".join(wait["servers"])
    sentence = f"{wait['node']} called {wait['service']}" + (f" and waited for {servers}" if servers else "")
    if wait["open"]:
        return f"{sentence}{'' if servers else ' and waited'} until the recording ended."
    if not servers:
        return f"{sentence}, but reached no server."
    if wait["failed"] == wait["calls"]:
        return f"{sentence}, and each call failed."
    return f"{sentence}, and some calls failed." if wait["failed"] else f"{sentence}."


def _published(stream: Stream) -> str:
    sentence = f"{stream['node']} published on {stream['topic']} and did not wait"
    if stream["heard_by"]:
        return f"{sentence}; {' and '.join(stream['heard_by'])} received messages."
    lost = stream["alone"] == stream["published"]
    return f"{sentence}; {'no subscriber was connected' if lost else 'no recorded node received messages'}."
