"""Tests of the data of a timeline and its description."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from course_pkg.panels import Timeline, timeline_text
from course_pkg.panels.timeline.model import MOST, OPEN, arrows, rows_of, state
from course_pkg.panels.timeline.waits import waits_of
from course_pkg.ros import Event, Recording


def call(key: str = "call 1", at: float = 0.0, **more: str) -> list[Event]:
    """Return the events of a call of 1 s; the handler runs for 0.6 s."""
    who = {"caller": "/customer", "server": "/cashier", "thread": "MainThread", **more}
    caller, server, thread = who["caller"], who["server"], who["thread"]
    return [
        Event("lookup", caller, "/x", at, at + 0.1, "master", key, thread),
        Event("connect", caller, "/x", at + 0.1, at + 0.2, server, key, thread),
        Event("request", caller, "/x", at + 0.2, at + 0.3, server, key, thread),
        Event("wait", caller, "/x", at + 0.3, at + 1.0, server, key, thread),
        Event("handler", server, "/x", at + 0.35, at + 0.95, caller, key, f"Thread-{key}"),
        Event("response", caller, "/x", at + 1.0, at + 1.0, server, key, thread),
    ]


def message(number: int, at: float, *hearers: str) -> list[Event]:
    """Return the event of a published message, and the events of its callbacks."""
    key = f"message {number}"
    sent = Event("publish", "/robot", "/joints", at, at + 0.001, ", ".join(hearers), key, "MainThread")
    return [
        sent,
        *(
            Event("callback", node, "/joints", at + 0.002, at + 0.004, "/robot", key, "/joints")
            for node in hearers
        ),
    ]


def recording(*events: Event, length: float = 10.0, **more: tuple[str, ...] | dict[str, str]) -> Recording:
    """Return a recording with the given events and the given length in s."""
    ordered = tuple(sorted(events, key=lambda event: event.start))
    return Recording(
        events=ordered, nodes=tuple(sorted({event.node for event in events})), length=length, **more
    )


def drawn(found: Recording) -> list[tuple[str, str]]:
    """For each arrow, return the kinds of the two events that the arrow connects."""
    return [(found.events[tail].kind, found.events[head].kind) for tail, head in arrows(found.events)]


def test_a_call_has_two_arrows() -> None:
    """A call has one arrow to the handler and one arrow back to the caller."""
    assert drawn(recording(*call())) == [("request", "handler"), ("handler", "response")]


def test_what_was_not_recorded_is_not_drawn() -> None:
    """If the recording contains only one of two connected events, the timeline draws no arrow."""
    handler = [event for event in call() if event.kind == "handler"]
    caller = [event for event in call() if event.kind != "handler"]
    callback = message(1, 1.0, "/simulator")[1:]
    for events in (handler, caller, callback):
        assert drawn(recording(*events)) == []


def test_a_call_that_timed_out_has_no_response() -> None:
    """A call that timed out has no arrow for the response."""
    *asked, handler, _ = call()
    gave_up = Event("error", "/customer", "/x", 0.5, 0.5, "", "call 1", "MainThread", "CallTimeout")
    refused = Event("error", "/customer", "/x", 1.0, 1.0, "/cashier", "call 1", "MainThread", "no")
    assert drawn(recording(*asked, handler, gave_up)) == [("request", "handler")]
    assert drawn(recording(*asked, handler, refused)) == [("request", "handler"), ("handler", "error")]


def test_a_call_that_never_ended() -> None:
    """A call that has not ended has one arrow, from the caller's event "wait" to the handler's event."""
    wait = Event("wait", "/customer", "/x", -3.0, None, "/cashier", "call 1", "MainThread")
    handler = Event("handler", "/cashier", "/x", -2.9, None, "/customer", "call 1", "Thread-1")
    found = recording(wait, handler)
    assert drawn(found) == [("wait", "handler")]
    assert state(found)["columns"]["end"] == [OPEN, OPEN]


def test_a_message_has_an_arrow_to_each_callback() -> None:
    """A message to two subscribers has two arrows."""
    assert drawn(recording(*message(1, 1.0, "/simulator", "/plotter"))) == [("publish", "callback")] * 2


def test_threads_that_work_at_once_stand_below_each_other() -> None:
    """Handlers that run at the same time are in different rows of the timeline."""
    overlapping = [
        Event("handler", "/s", "/x", at, at + 1, "/c", f"call {at}", f"Thread-{at}") for at in (0, 0.5, 0.9)
    ]
    assert rows_of(overlapping)[0] == [0, 1, 2]
    in_turn = [
        Event("handler", "/s", "/x", at, at + 1, "/c", f"call {at}", f"Thread-{at}") for at in (0, 2, 4)
    ]
    assert rows_of(in_turn)[0] == [0, 0, 0]


def test_a_thread_keeps_its_row() -> None:
    """All events of a thread are in the same row."""
    events = [
        Event("callback", "/n", "/a", 0, 1, thread="/a"),
        Event("handler", "/n", "/x", 0.5, 1.5, thread="Thread-1"),
        Event("callback", "/n", "/a", 2, 3, thread="/a"),
    ]
    assert rows_of(events)[0] == [0, 1, 0]


def test_a_call_within_a_callback_is_inset() -> None:
    """An event that occurs during another event of the same thread is drawn inside that event."""
    callback = Event("callback", "/customer", "/go", -0.1, 1.5, thread="/go")
    after = Event("callback", "/customer", "/go", 2.0, 2.1, thread="/go")
    found = recording(callback, *(e for e in call(thread="/go") if e.node == "/customer"), after)
    rows, depths = rows_of(found.events)
    assert rows == [0] * 7
    assert depths == [0, 1, 1, 1, 1, 1, 0]


def test_fifty_overlapping_calls() -> None:
    """Fifty simultaneous calls need fifty rows for the callers and fifty rows for the handlers."""
    events = [event for n in range(50) for event in call(f"call {n}", n / 1000, thread=f"caller {n}")]
    lanes = state(recording(*events))["lanes"]
    assert lanes == [{"node": "/customer", "rows": 50}, {"node": "/cashier", "rows": 50}]


def test_the_state_is_bounded() -> None:
    """If there are too many events, a note contains the number of events that are not drawn."""
    stream = [event for n in range(5000) for event in message(n, n / 1000, "/simulator")]
    kept = state(recording(*stream, *call(at=4.0)))
    kinds = [kept["kinds"][kind] for kind in kept["columns"]["kind"]]
    assert len(kinds) == MOST
    assert kinds.count("wait") == 1
    said = (
        "4,000 events are drawn. 6,006 messages and callbacks that begin at 1.998 s or later are not drawn."
    )
    assert kept["notes"] == [said]
    assert len(json.dumps(kept)) < 400_000
    assert kept["waits"]["streams"][0]["published"] == 5000


def test_too_many_calls() -> None:
    """If there are too many events, the timeline draws only the first events; a note gives the numbers."""
    calls = [event for n in range(1000) for event in call(f"call {n}", float(n))]
    kept = state(recording(*calls, length=1001.0))
    assert len(kept["columns"]["kind"]) == MOST
    assert kept["notes"] == [
        "4,000 events are drawn. 2,000 events that begin at 666.4 s or later are not drawn."
    ]


def test_nothing_recorded() -> None:
    """If no event was recorded, the panel only lists the nodes."""
    empty = state(Recording(nodes=("/a",), unrecorded={"/b": "its process has ended"}, length=1.0))
    assert (empty["lanes"], empty["arrows"], empty["idle"]) == ([], [], ["/a"])
    assert empty["unrecorded"] == [["/b", "its process has ended"]]


def test_all_that_is_shown_comes_from_the_recording() -> None:
    """The timeline contains each event, with times in whole microseconds."""
    found = recording(*call(), *message(1, 2.0, "/simulator"))
    kept = state(found)
    columns, words = kept["columns"], kept["strings"]
    for number, event in enumerate(found.events):
        assert kept["kinds"][columns["kind"][number]] == event.kind
        assert kept["lanes"][columns["lane"][number]]["node"] == event.node
        assert columns["start"][number] == round(event.start * 1e6)
        assert columns["end"][number] == round((event.end or 0.0) * 1e6)
        texts = [words[columns[name][number]] for name in ("name", "peer", "key", "thread", "note")]
        assert texts == [event.name, event.peer, event.key, event.thread, event.note]


def test_who_waited_how_long() -> None:
    """The waiting time of a call includes the look-up, the connection and the wait for the response."""
    waits = waits_of(recording(*call(), *call("call 2", 2.0), *message(1, 2.0, "/simulator")))
    (wait,), (stream,) = waits["calls"], waits["streams"]
    assert (wait["node"], wait["service"], wait["servers"]) == ("/customer", "/x", ["/cashier"])
    assert (wait["calls"], round(wait["blocked"], 6), round(wait["longest"], 6)) == (2, 1.8, 0.9)
    assert (stream["published"], stream["heard_by"]) == (1, ["/simulator"])


def test_an_open_wait_counts_to_the_end() -> None:
    """An unfinished wait is counted until the end of the recording."""
    wait = Event("wait", "/customer", "/x", -3.0, None, "/cashier", "call 1", "MainThread")
    (found,) = waits_of(recording(wait, length=2.0))["calls"]
    assert (found["blocked"], found["open"]) == (2.0, 1)


def test_in_plain_sentences() -> None:
    """The description says which node waited for which node."""
    error = Event("error", "/customer", "/nope", 5.1, 5.1, "", "call 8", "MainThread", "unavailable")
    lookup = Event("lookup", "/customer", "/nope", 5.0, 5.1, "master", "call 8", "MainThread")
    late = Event("wait", "/late", "/x", 6.0, None, "/cashier", "call 9", "MainThread")
    found = recording(late, lookup, error, *call(), *call("call 2", 2.0), *message(1, 2.0, "/simulator"))
    assert timeline_text(found).splitlines() == [
        "/customer called /nope, but reached no server.",
        "/customer called /x and waited for /cashier.",
        "/late called /x and waited for /cashier until the recording ended.",
        "/robot published on /joints and did not wait; /simulator received messages.",
    ]
    assert timeline_text(Recording()) == "Nothing was recorded."


def test_messages_without_a_subscriber() -> None:
    """If no node received a message, the description says whether a subscriber was connected."""
    (sent,) = message(1, 1.0)
    assert timeline_text(recording(sent)).endswith("no recorded node received messages.")
    lost = replace(sent, note="no subscriber was connected")
    assert timeline_text(recording(lost)).endswith("no subscriber was connected.")
    assert waits_of(recording(lost, sent))["streams"][0]["alone"] == 1


@pytest.mark.parametrize(("failed", "words"), [(1, "and each call failed"), (2, "and some calls failed")])
def test_failures_in_plain_sentences(failed: int, words: str) -> None:
    """The description contains the number of failed calls."""
    error = Event("error", "/customer", "/x", 1.0, 1.0, "/cashier", "call 1", "MainThread", "no")
    found = recording(*call()[:-1], error, *(call("call 2", 2.0) if failed == 2 else []))
    assert timeline_text(found) == f"/customer called /x and waited for /cashier, {words}."


def test_the_panel() -> None:
    """The text/plain output of the timeline contains no data, so the output is the same in every run."""
    panel = Timeline(recording(*call()))
    assert repr(panel) == "Timeline()"
    assert panel.recorded["length"] == 10_000_000
    panel.close()
