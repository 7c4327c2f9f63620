"""What belongs together is found by what is on the wire; where that is not certain, it stays apart."""

from __future__ import annotations

from typing import Any

from course_pkg.graph import Event
from course_pkg.graph.matching import Record, matched

WIRE = ["127.0.0.1:40000>50000", 1, "/other"]


def mark(kind: str, start: float, end: float | None = None, **more: Any) -> dict[str, Any]:  # noqa: ANN401
    """Make up what a process tells of one thing."""
    told = {
        "kind": kind,
        "name": "/x",
        "start": start,
        "end": end,
        "peer": "/other",
        "call": 0,
        "wires": [WIRE],
    }
    return {**told, "asked": 1, "note": "", "thread": ["MainThread", 1], **more}


def events(*records: list[dict[str, Any]], start: float = 0.0, end: float = 100.0) -> tuple[Event, ...]:
    """Match what the processes /n0, /n1, … tell."""
    return matched([Record(f"/n{number}", number, marks) for number, marks in enumerate(records)], start, end)


def keys(found: tuple[Event, ...]) -> list[tuple[str, str]]:
    """Return kind and key of each."""
    return [(event.kind, event.key) for event in found]


def call(number: int, start: float, end: float) -> list[dict[str, Any]]:
    """Make up a caller's side of a call."""
    return [
        mark("request", start, start + 0.1, call=number),
        mark("wait", start + 0.1, end, call=number),
        mark("response", end, end, call=number),
    ]


def test_same_wire_same_call() -> None:
    """A handler belongs to the call whose request came over the same connection with the same number."""
    assert keys(events(call(1, 1, 3), [mark("handler", 2, 2.5)])) == [
        ("request", "call 1"),
        ("wait", "call 1"),
        ("handler", "call 1"),
        ("response", "call 1"),
    ]


def test_another_number_is_another_call() -> None:
    """The next request over the same connection is not taken for this one."""
    found = events(call(1, 1, 3), [mark("handler", 2, 2.5, wires=[[*WIRE[:1], 2, "/n0"]])])
    assert ("handler", "call 2") in keys(found)


def test_another_service_on_the_same_ports() -> None:
    """A handler of another service is none of this call's, whatever its ports."""
    assert ("handler", "call 2") in keys(events(call(1, 1, 3), [mark("handler", 2, 2.5, name="/y")]))


def test_a_port_that_was_used_again() -> None:
    """Two calls or two handlers with the same ports are not told apart: nothing is matched."""
    twice = events([*call(1, 1, 3), *call(2, 11, 13)], [mark("handler", 2, 2.5), mark("handler", 12, 12.5)])
    assert [key for kind, key in keys(twice) if kind == "handler"] == ["call 2", "call 4"]
    assert [key for kind, key in keys(twice) if kind == "request"] == ["call 1", "call 3"]


def test_times_that_contradict() -> None:
    """A handler that began before the request, or after the answer was there, is not the one."""
    for start in (0.5, 4.0):
        found = dict(keys(events(call(1, 1, 3), [mark("handler", start, start + 0.1)])))
        assert found["handler"] != found["request"]


def test_calls_of_two_processes_with_one_number() -> None:
    """Each process numbers its own calls, also when both were the same node, one after the other."""
    first, second = ([mark("lookup", start, start + 0.1, call=1, wires=[])] for start in (1.0, 2.0))
    records = [Record("/n", 10, first), Record("/n", 11, second)]
    assert [event.key for event in matched(records, 0, 100)] == ["call 1", "call 2"]


def test_one_message_many_callbacks() -> None:
    """All callbacks of a message belong to it, over whichever connection it went."""
    wires = [WIRE, ["127.0.0.1:40001>50000", 9, "/n2"]]
    found = events(
        [mark("publish", 1, 1.1, wires=wires)],
        [mark("callback", 2, 3)],
        [mark("callback", 2, 3, wires=wires[1:])],
    )
    assert {event.key for event in found} == {"message 1"}
    assert found[0].peer == "/n2, /other"


def test_a_callback_of_an_unknown_message() -> None:
    """A callback whose message is not on record, or came too late for it, stands alone."""
    assert keys(events([mark("callback", 2, 3, wires=[])])) == [("callback", "message 1")]
    assert len({event.key for event in events([mark("publish", 5, 6)], [mark("callback", 2, 3)])}) == 2


def test_the_window() -> None:
    """What ended before the recording or began after it is left out; what outlasts it is open."""
    marks = [mark("publish", 1, 2), mark("publish", 4, 6), mark("publish", 8, 12), mark("publish", 11, 12)]
    found = events(marks, start=5, end=10)
    assert [(event.start, event.end) for event in found] == [(-1, 1), (3, None)]


def test_threads_of_one_name() -> None:
    """Two threads of one name in one node are told apart."""
    marks = [mark("callback", start, start + 1, wires=[], thread=["/x", start]) for start in (1, 2)]
    assert [event.thread for event in events(marks)] == ["/x", "/x (2)"]


def test_a_message_that_was_dropped() -> None:
    """A message that went over fewer connections than there were says so, if the sending is over."""
    (lost,) = events([mark("publish", 1, 2, asked=2)])
    assert "sent to 1 of 2" in lost.note
    (going,) = events([mark("publish", 1, None, asked=2)])
    assert going.note == ""
