"""The recorder of a process: the latest calls, messages and callbacks, and the call count of each caller.

Times are values of time.monotonic(). On Linux, time.monotonic() reads CLOCK_MONOTONIC. All processes of a
machine share this clock, so the times of several nodes can be compared. Sources: clock_gettime(2) and
https://docs.python.org/3/library/time.html#time.monotonic ("system-wide").

This module does not import rospy. The modules `service_hooks` and `topic_hooks` call the recorder.
"""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Sequence
from functools import cache
from itertools import count

from course_pkg.ros.trace.call_counter import CallCounter
from course_pkg.ros.trace.recording import (
    ERROR,
    LOOKUP,
    MASTER,
    REQUEST,
    RESPONSE,
    WAIT,
    ProcessRecord,
    SpanData,
    Thread,
)

SIZE = 20_000  # The recorder stores at most this many spans, about 6 MB.
HANDED_OVER = 50  # The recorder stores at most this many records of nodes that have ended.
LONGEST = 300  # A longer error message is shortened to this number of characters.

EXCHANGED = (REQUEST, WAIT, RESPONSE)  # These phases of a call use the connection.

# A connection is identified by the client's numeric address and the server's port. Client and server both
# know these values.
Connection = tuple[Sequence[str | int], int]
# A message is identified by its connection and its number on this connection.
Transfer = tuple[Connection, int, str]


class Span:
    """One action of a node, such as a published message; `end` is None until the action has ended.

    `transfers` contains the messages of the action, each with its connection and number. `connections` is the
    number of subscribers to which a published message should be sent.
    """

    __slots__ = ("connections", "end", "kind", "name", "note", "peer", "start", "thread", "transfers")

    def __init__(self, kind: str, name: str, peer: str, transfers: list[Transfer], thread: Thread) -> None:
        self.kind = kind
        self.name = name
        self.peer = peer
        self.transfers = transfers
        self.thread = thread
        self.connections = 0
        self.note = ""
        self.end: float | None = None
        self.start = time.monotonic()

    def as_dicts(self) -> list[SpanData]:
        """Return the span as a list with one item of JSON data."""
        return [
            {
                "kind": self.kind,
                "name": self.name,
                "start": self.start,
                "end": self.end,
                "peer": self.peer,
                "call": 0,
                "transfers": [_transfer_data(each) for each in list(self.transfers)],
                "connections": self.connections,
                "note": self.note,
                "thread": self.thread,
            }
        ]


class CallPart:
    """A phase of a call, such as the lookup; `end` is None until the phase has ended."""

    __slots__ = ("end", "kind", "start")

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.end: float | None = None
        self.start = time.monotonic()


class CallSpan:
    """A call with all its phases.

    One object stores all phases of a call, because the recorder must not make calls slower. `result` is
    RESPONSE or ERROR, and empty until the call has ended. `transfer` is the connection and number of the
    request.
    """

    __slots__ = (
        "answered",
        "end",
        "name",
        "note",
        "number",
        "parts",
        "peer",
        "result",
        "start",
        "thread",
        "transfer",
    )

    def __init__(self, name: str, number: int, thread: Thread) -> None:
        self.name = name
        self.number = number
        self.thread = thread
        self.parts: list[CallPart] = []
        self.peer = ""
        self.note = ""
        self.result = ""
        self.answered = False
        self.transfer: Transfer | None = None
        self.end: float | None = None
        self.start = time.monotonic()

    def begin(self, kind: str) -> CallPart:
        """Record that a phase begins, and return its CallPart; the caller of this method sets `end` later."""
        part = CallPart(kind)
        self.parts.append(part)
        return part

    def finish(self, result: str, note: str = "", *, answered: bool = True) -> None:
        """Record the call's result; `answered` is false if the result did not come from the server."""
        part = self.begin(result)
        part.end = part.start
        self.result = result
        self.answered = answered
        self.note = note[:LONGEST]

    def as_dicts(self) -> list[SpanData]:
        """Return all phases as JSON data."""
        return [self._part_data(part) for part in list(self.parts)]

    def _part_data(self, part: CallPart) -> SpanData:
        unanswered = part.kind == ERROR and not self.answered
        exchanged = self.transfer is not None and part.kind in EXCHANGED
        return {
            "kind": part.kind,
            "name": self.name,
            "start": part.start,
            "end": part.end,
            "peer": MASTER if part.kind == LOOKUP else "" if unanswered else self.peer,
            "call": self.number,
            "transfers": [_transfer_data(self.transfer)] if exchanged and self.transfer else [],
            "connections": 0,
            "note": self.note if part.kind == self.result else "",
            "thread": self.thread,
        }


class _Current(threading.local):
    """The call that a thread is making, or None if the thread is making no call."""

    call: CallSpan | None = None


class Recorder:
    """The spans of this process: the last 20,000 ended spans, and all spans that have not ended.

    Several threads may use one recorder, because each step is one atomic operation of a set or a deque.
    """

    def __init__(self, size: int = SIZE) -> None:
        self.call_counter = CallCounter()
        self.unsupported: set[str] = set()  # Each string describes an action that this process cannot record.
        self.current = _Current()
        self.recordings = 0  # This is the number of recordings that the process is making.
        # These are records of nodes that have ended.
        self.handed_over: deque[tuple[str, ProcessRecord]] = deque(maxlen=HANDED_OVER)
        self.numbers = count(1)
        self._ended: deque[Span | CallSpan] = deque(maxlen=size)
        self._lasting: set[Span | CallSpan] = set()

    def begin(self, kind: str, name: str, peer: str, transfers: list[Transfer]) -> Span:
        """Record that an action begins, and return its span."""
        span = Span(kind, name, peer, transfers, _thread())
        self._lasting.add(span)
        return span

    def begin_call(self, name: str) -> CallSpan:
        """Record that this thread begins a call, and return the call's span."""
        call = CallSpan(name, next(self.numbers), _thread())
        self._lasting.add(call)
        self.current.call = call
        return call

    def end(self, span: Span | CallSpan, note: str = "") -> None:
        """Record that a span ends; a second call has no effect."""
        if span.end is None:
            span.end = time.monotonic()
            if note:
                span.note = note[:LONGEST]
            # The span is first added to `_ended`, so other threads always find it in at least one collection.
            self._ended.append(span)
            self._lasting.discard(span)

    def since(self, start: float) -> ProcessRecord:
        """Return the record of all actions that were running at the time `start`, or that began later.

        `start` is a value of time.monotonic().
        """
        recent = [span for span in self._spans() if span.end is None or span.end >= start]
        return {
            "clock": time.monotonic(),
            "process": os.getpid(),
            "complete_from": self._complete_from(),
            "unsupported": sorted(self.unsupported),
            "spans": [data for span in recent for data in span.as_dicts()],
        }

    def _spans(self) -> list[Span | CallSpan]:
        while True:
            try:
                return list(
                    {id(span): span for span in (*self._lasting.copy(), *self._ended.copy())}.values()
                )
            except RuntimeError:  # Another thread has changed the collections during the copy.
                continue

    def _complete_from(self) -> float:
        full = len(self._ended) == self._ended.maxlen
        return (self._ended[0].end or 0.0) if full else 0.0


def _transfer_data(transfer: Transfer) -> tuple[str, int, str]:
    (client, port), number, peer = transfer
    return f"{client[0]}:{client[1]}>{port}", number, peer


def _thread() -> Thread:
    # Do not store the thread object: a server creates a new thread for each call, and the spans would keep
    # all these threads in memory.
    thread = threading.current_thread()
    return thread.name, thread.ident or 0


@cache
def recorder() -> Recorder:
    """Return the only recorder of this process."""
    return Recorder()
