"""A process keeps the last of what it did, all that lasts, and who called its services."""

from __future__ import annotations

import threading

from course_pkg.graph.tally import KEPT, Tally
from course_pkg.graph.taps import Tap
from course_pkg.graph.trace import LONGEST, Recorder


def test_the_ring_is_bounded() -> None:
    """Of what is over the last is kept, what lasts in any case, and since when it is whole is told."""
    recorder = Recorder(size=3)
    lasting = recorder.begin("handler", "/x", "/caller", [])
    marks = [recorder.begin("publish", f"/{number}", "", []) for number in range(5)]
    for mark in marks:
        recorder.end(mark)
    told = recorder.since(0.0)
    assert {each["name"] for each in told["marks"]} == {"/x", "/2", "/3", "/4"}
    assert told["complete_from"] == marks[2].end
    assert lasting.end is None


def test_a_small_ring_that_is_not_full_is_complete() -> None:
    """As long as nothing was pushed out, the record is complete from the beginning."""
    recorder = Recorder(size=3)
    recorder.end(recorder.begin("publish", "/x", "", []))
    assert recorder.since(0.0)["complete_from"] == 0.0


def test_an_end_counts_once() -> None:
    """A second end changes neither the time nor the words."""
    recorder = Recorder()
    mark = recorder.begin("handler", "/x", "/caller", [])
    recorder.end(mark, "the first")
    recorder.end(mark, "the second")
    (told,) = recorder.since(0.0)["marks"]
    assert told["note"] == "the first"


def test_long_words_are_cut() -> None:
    """Neither a handler's nor a caller's error is kept at any length."""
    recorder = Recorder()
    recorder.end(recorder.begin("handler", "/x", "/caller", []), "x" * 10_000)
    call = recorder.begin_call("/x")
    call.settle("error", "y" * 10_000, answered=False)
    recorder.end(call)
    assert [len(told["note"]) for told in recorder.since(0.0)["marks"]] == [LONGEST, LONGEST]


def test_reading_while_others_write() -> None:
    """What is told is whole, however many threads write meanwhile."""
    recorder = Recorder(size=1000)
    stop = threading.Event()

    def write() -> None:
        while not stop.is_set():
            recorder.end(recorder.begin("publish", "/x", "", []))

    writers = [threading.Thread(target=write) for _ in range(4)]
    for writer in writers:
        writer.start()
    counts = [len(recorder.since(0.0)["marks"]) for _ in range(200)]
    stop.set()
    for writer in writers:
        writer.join()
    assert max(counts) <= 1000 + len(writers)
    assert len(recorder.since(0.0)["marks"]) == 1000


def test_a_tally() -> None:
    """Calls are counted by service and caller, the latest caller first, with those that are running."""
    tally = Tally()
    for caller in ("/a", "/b", "/a"):
        tally.begun("/x", caller)
    tally.ended("/x", "/a")
    assert [(name, calls, running) for name, calls, _, running in tally.callers("/x")] == [
        ("/a", 2, 1),
        ("/b", 1, 1),
    ]
    assert tally.callers("/y") == []


def test_a_tally_forgets_who_called_longest_ago() -> None:
    """There is room for so many callers, and one that still waits is not the one to go."""
    tally = Tally()
    tally.begun("/x", "/waiting")
    for number in range(KEPT + 10):
        tally.begun("/x", f"/tool_{number}")
        tally.ended("/x", f"/tool_{number}")
    names = [str(name) for name, *_ in tally.callers("/x")]
    assert len(names) == KEPT
    assert names[0] == f"/tool_{KEPT + 9}"
    assert "/waiting" in names
    assert "/tool_0" not in names


class _Owner:
    def method(self, one: int) -> int:
        return one


def test_a_tap_fits_what_it_expects() -> None:
    """A method with other parameters, with other globals, or none at all, does not fit."""
    assert Tap(_Owner, "method", ("self", "one"), lambda bare: bare).fits()
    assert not Tap(_Owner, "method", ("self", "two"), lambda bare: bare).fits()
    assert not Tap(_Owner, "method", ("self", "one"), lambda bare: bare, uses=["elsewhere"]).fits()
    assert not Tap(_Owner, "missing", (), lambda bare: bare).fits()


def test_a_tap_is_put_once() -> None:
    """A method is replaced once, however often that is asked for."""

    class Owner(_Owner):
        pass

    tap = Tap(Owner, "method", ("self", "one"), lambda bare: lambda self, one: bare(self, one) + 1)
    tap.put()
    tap.put()
    assert Owner().method(1) == 2
