"""Tests of match_events(), which makes calls and messages from spans (recorded periods) of several nodes."""

from __future__ import annotations

from collections.abc import Sequence

from course_pkg.ros import Event
from course_pkg.ros.trace.matching import NodeRecord, match_events
from course_pkg.ros.trace.recording import SpanData

TRANSFER = ("127.0.0.1:40000>50000", 1, "/other")


def span(
    kind: str,
    start: float,
    end: float | None = None,
    *,
    name: str = "/x",
    peer: str = "/other",
    call: int = 0,
    transfers: Sequence[tuple[str, int, str]] = (TRANSFER,),
    connections: int = 1,
    note: str = "",
    thread: tuple[str, int] = ("MainThread", 1),
) -> SpanData:
    """Return a span as a process records it."""
    return {
        "kind": kind,
        "name": name,
        "start": start,
        "end": end,
        "peer": peer,
        "call": call,
        "transfers": transfers,
        "connections": connections,
        "note": note,
        "thread": thread,
    }


def events(*records: list[SpanData], start: float = 0.0, end: float = 100.0) -> tuple[Event, ...]:
    """Pass the spans of several processes to match_events(), and return the resulting events."""
    found = [NodeRecord(f"/n{number}", number, spans) for number, spans in enumerate(records)]
    return match_events(found, start, end)


def keys(found: tuple[Event, ...]) -> list[tuple[str, str]]:
    """Return the kind and the key (such as "call 2") of each event."""
    return [(event.kind, event.key) for event in found]


def call(number: int, start: float, end: float) -> list[SpanData]:
    """Return the spans that the calling process records for one call."""
    return [
        span("request", start, start + 0.1, call=number),
        span("wait", start + 0.1, end, call=number),
        span("response", end, end, call=number),
    ]


def test_same_connection_and_number_is_the_same_call() -> None:
    """A handler belongs to the call with the same connection and the same call number."""
    assert keys(events(call(1, 1, 3), [span("handler", 2, 2.5)])) == [
        ("request", "call 1"),
        ("wait", "call 1"),
        ("handler", "call 1"),
        ("response", "call 1"),
    ]


def test_another_number_is_another_call() -> None:
    """A handler with another call number belongs to another call."""
    found = events(call(1, 1, 3), [span("handler", 2, 2.5, transfers=[(TRANSFER[0], 2, "/n0")])])
    assert ("handler", "call 2") in keys(found)


def test_another_service_on_the_same_ports() -> None:
    """A handler of another service does not belong to the call, even if the ports are the same."""
    assert ("handler", "call 2") in keys(events(call(1, 1, 3), [span("handler", 2, 2.5, name="/y")]))


def test_a_port_that_was_used_again() -> None:
    """If two calls have the same ports and call number, a handler is not assigned to any call."""
    twice = events([*call(1, 1, 3), *call(2, 11, 13)], [span("handler", 2, 2.5), span("handler", 12, 12.5)])
    assert [key for kind, key in keys(twice) if kind == "handler"] == ["call 2", "call 4"]
    assert [key for kind, key in keys(twice) if kind == "request"] == ["call 1", "call 3"]


def test_contradictory_times() -> None:
    """A handler that began before the request does not belong to the call."""
    for start in (0.5, 4.0):
        found = dict(keys(events(call(1, 1, 3), [span("handler", start, start + 0.1)])))
        assert found["handler"] != found["request"]


def test_calls_of_two_processes_with_one_number() -> None:
    """Calls of two processes are different calls, even if their call numbers are equal."""
    first, second = ([span("lookup", start, start + 0.1, call=1, transfers=[])] for start in (1.0, 2.0))
    records = [NodeRecord("/n", 10, first), NodeRecord("/n", 11, second)]
    assert [event.key for event in match_events(records, 0, 100)] == ["call 1", "call 2"]


def test_one_message_many_callbacks() -> None:
    """All callbacks that received a message are assigned to this message."""
    wires = [TRANSFER, ["127.0.0.1:40001>50000", 9, "/n2"]]
    found = events(
        [span("publish", 1, 1.1, transfers=wires)],
        [span("callback", 2, 3)],
        [span("callback", 2, 3, transfers=wires[1:])],
    )
    assert {event.key for event in found} == {"message 1"}
    assert found[0].peer == "/n2, /other"


def test_a_callback_of_an_unknown_message() -> None:
    """If the message of a callback was not recorded, the callback is not assigned to a message."""
    assert keys(events([span("callback", 2, 3, transfers=[])])) == [("callback", "message 1")]
    assert len({event.key for event in events([span("publish", 5, 6)], [span("callback", 2, 3)])}) == 2


def test_events_outside_of_the_recording() -> None:
    """match_events() omits events before or after the recorded time.

    If an event has not ended when the recording ends, its end is None.
    """
    spans = [span("publish", 1, 2), span("publish", 4, 6), span("publish", 8, 12), span("publish", 11, 12)]
    found = events(spans, start=5, end=10)
    assert [(event.start, event.end) for event in found] == [(-1, 1), (3, None)]


def test_threads_of_one_name() -> None:
    """If two threads of a node have the same name, match_events() adds a number to the second name."""
    spans = [span("callback", start, start + 1, transfers=[], thread=["/x", start]) for start in (1, 2)]
    assert [event.thread for event in events(spans)] == ["/x", "/x (2)"]


def test_a_message_that_was_dropped() -> None:
    """If a message was not sent to all connections, the event of the message has a note."""
    (lost,) = events([span("publish", 1, 2, connections=2)])
    assert "sent to 1 of 2" in lost.note
    (going,) = events([span("publish", 1, None, connections=2)])
    assert going.note == ""
