"""Tests of the spans (periods with a start and an end) and the callers that a process records."""

from __future__ import annotations

import threading

from course_pkg.ros.trace.call_counter import CALLERS, CallCounter
from course_pkg.ros.trace.hooks import Hook
from course_pkg.ros.trace.recorder import LONGEST, Recorder


def test_the_number_of_stored_spans_is_bounded() -> None:
    """The recorder stores the latest finished spans, and all spans that have not ended."""
    recorder = Recorder(size=3)
    lasting = recorder.begin("handler", "/x", "/caller", [])
    spans = [recorder.begin("publish", f"/{number}", "", []) for number in range(5)]
    for span in spans:
        recorder.end(span)
    record = recorder.since(0.0)
    assert {each["name"] for each in record["spans"]} == {"/x", "/2", "/3", "/4"}
    assert record["complete_from"] == spans[2].end
    assert lasting.end is None


def test_a_memory_that_is_not_full_is_complete() -> None:
    """As long as the recorder has deleted no span, its record is complete."""
    recorder = Recorder(size=3)
    recorder.end(recorder.begin("publish", "/x", "", []))
    assert recorder.since(0.0)["complete_from"] == 0.0


def test_an_end_counts_once() -> None:
    """If end() is called a second time for a span, the span does not change."""
    recorder = Recorder()
    span = recorder.begin("handler", "/x", "/caller", [])
    recorder.end(span, "the first")
    recorder.end(span, "the second")
    (span_data,) = recorder.since(0.0)["spans"]
    assert span_data["note"] == "the first"


def test_long_error_messages_are_cut() -> None:
    """The recorder shortens long error messages of handlers and callers."""
    recorder = Recorder()
    recorder.end(recorder.begin("handler", "/x", "/caller", []), "x" * 10_000)
    call = recorder.begin_call("/x")
    call.finish("error", "y" * 10_000, answered=False)
    recorder.end(call)
    assert [len(each["note"]) for each in recorder.since(0.0)["spans"]] == [LONGEST, LONGEST]


def test_reading_while_others_write() -> None:
    """While other threads write, since() returns all stored spans."""
    recorder = Recorder(size=1000)
    stop = threading.Event()

    def write() -> None:
        while not stop.is_set():
            recorder.end(recorder.begin("publish", "/x", "", []))

    writers = [threading.Thread(target=write) for _ in range(4)]
    for writer in writers:
        writer.start()
    counts = [len(recorder.since(0.0)["spans"]) for _ in range(200)]
    stop.set()
    for writer in writers:
        writer.join()
    assert max(counts) <= 1000 + len(writers)
    assert len(recorder.since(0.0)["spans"]) == 1000


def test_calls_are_counted_by_caller() -> None:
    """The recorder counts the calls for each service and caller, and lists the latest caller first."""
    counter = CallCounter()
    for caller in ("/a", "/b", "/a"):
        counter.begin("/x", caller)
    counter.end("/x", "/a")
    assert [(name, calls, running) for name, calls, _, running in counter.callers("/x")] == [
        ("/a", 2, 1),
        ("/b", 1, 1),
    ]
    assert counter.callers("/y") == []


def test_the_caller_with_the_oldest_call_is_forgotten() -> None:
    """The recorder stores a limited number of callers, but never deletes a caller that is waiting."""
    counter = CallCounter()
    counter.begin("/x", "/waiting")
    for number in range(CALLERS + 10):
        counter.begin("/x", f"/tool_{number}")
        counter.end("/x", f"/tool_{number}")
    names = [str(name) for name, *_ in counter.callers("/x")]
    assert len(names) == CALLERS
    assert names[0] == f"/tool_{CALLERS + 9}"
    assert "/waiting" in names
    assert "/tool_0" not in names


class _Owner:
    def method(self, one: int) -> int:
        return one


def test_a_hook_fits_only_the_expected_method() -> None:
    """fits() returns False if the method or an attribute is missing, or if the parameters differ."""
    assert Hook(_Owner, "method", ("self", "one"), lambda method: method).fits()
    assert not Hook(_Owner, "method", ("self", "two"), lambda method: method).fits()
    assert not Hook(_Owner, "method", ("self", "one"), lambda method: method, uses=["elsewhere"]).fits()
    assert not Hook(_Owner, "missing", (), lambda method: method).fits()


def test_a_hook_is_installed_once() -> None:
    """A second install() of the same hook has no effect."""

    class Owner(_Owner):
        pass

    hook = Hook(Owner, "method", ("self", "one"), lambda method: lambda self, one: method(self, one) + 1)
    hook.install()
    hook.install()
    assert Owner().method(1) == 2
