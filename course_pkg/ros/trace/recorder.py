"""The recorder of a process: what its node did lately, in a bounded ring, and who called its services.

Times are those of time.monotonic(). On Linux that is CLOCK_MONOTONIC, one clock for all processes of a
machine: https://docs.python.org/3/library/time.html#time.monotonic ("system-wide") and clock_gettime(2). So
the times of several nodes can be compared. This module does not import rospy; `service_hooks` and
`topic_hooks` report to it what happens there.
"""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import count

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

SIZE = 20_000  # spans; about 6 MB when full
HANDED_OVER = 50  # records of nodes that have ended
LONGEST = 300  # characters of an error message
CALLERS = 100  # callers of a service; each run of a command-line tool is a caller with a new name

EXCHANGED = (REQUEST, WAIT, RESPONSE)  # the parts of a call that use the connection

# A connection as both ends know it: the client's numeric address, the server's port.
Connection = tuple[Sequence[str | int], int]
# One message on a connection: the connection, the number of the message on it, the node at the other end.
Transfer = tuple[Connection, int, str]
CallerCount = tuple[
    str, int, float, int
]  # caller, calls, when last (s since the epoch), calls that are running


class Span:
    """One thing that happened: `end` is None while it lasts.

    `transfers` are its messages on connections, `connections` is the number of connections that a published
    message is for.
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
        """Return it as data for JSON."""
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
    """A part of a call; `end` is None while it lasts."""

    __slots__ = ("end", "kind", "start")

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.end: float | None = None
        self.start = time.monotonic()


class CallSpan:
    """A call with all its parts, kept in one object because recording must not slow calls down.

    `result` is RESPONSE or ERROR, and empty while the call lasts; `transfer` is its request.
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
        """Record that a part begins, and return it; the caller sets its `end`."""
        part = CallPart(kind)
        self.parts.append(part)
        return part

    def finish(self, result: str, note: str = "", *, answered: bool = True) -> None:
        """Record how the call ended, and when; `answered` tells whether an error came from the server."""
        part = self.begin(result)
        part.end = part.start
        self.result = result
        self.answered = answered
        self.note = note[:LONGEST]

    def as_dicts(self) -> list[SpanData]:
        """Return its parts as data for JSON."""
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
    """What a thread does now: the call that it makes."""

    call: CallSpan | None = None


@dataclass
class _Count:
    calls: int = 0
    last: float = 0.0
    running: int = 0


class CallCounter:
    """Counts the requests of each service by caller; threads may share it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._services: dict[str, dict[str, _Count]] = {}

    def begin(self, service: str, caller: str) -> None:
        """Count a request that has reached its handler."""
        with self._lock:
            callers = self._services.setdefault(service, {})
            counted = callers.pop(caller, None) or _Count()
            counted.calls += 1
            counted.last = time.time()
            counted.running += 1
            callers[caller] = counted  # the latest caller is last
            if len(callers) > CALLERS:
                self._forget_one(callers)

    def end(self, service: str, caller: str) -> None:
        """Record that the handler of a request has ended."""
        with self._lock:
            counted = self._services.get(service, {}).get(caller)
            if counted is not None:
                counted.running -= 1

    def callers(self, service: str) -> list[CallerCount]:
        """Return the callers of a service, the latest first."""
        with self._lock:
            callers = self._services.get(service, {})
            return [(name, each.calls, each.last, each.running) for name, each in reversed(callers.items())]

    def _forget_one(self, callers: dict[str, _Count]) -> None:
        """Forget the caller whose last call is the oldest, of those that do not wait for a response."""
        idle = (name for name, each in callers.items() if not each.running)
        callers.pop(next(idle, next(iter(callers))))


class Recorder:
    """The spans of this process: the last 20,000 that have ended, and all that last.

    Threads may share it: each step is one atomic operation of a set or a deque.
    """

    def __init__(self, size: int = SIZE) -> None:
        self.call_counter = CallCounter()
        self.unsupported: set[str] = set()  # descriptions of what this process cannot record
        self.current = _Current()
        self.recordings = 0  # that are being made in this process
        self.handed_over: deque[tuple[str, ProcessRecord]] = deque(maxlen=HANDED_OVER)  # by nodes that ended
        self.numbers = count(1)
        self._ended: deque[Span | CallSpan] = deque(maxlen=size)
        self._lasting: set[Span | CallSpan] = set()

    def begin(self, kind: str, name: str, peer: str, transfers: list[Transfer]) -> Span:
        """Record that something begins."""
        span = Span(kind, name, peer, transfers, _thread())
        self._lasting.add(span)
        return span

    def begin_call(self, name: str) -> CallSpan:
        """Record that this thread begins a call."""
        call = CallSpan(name, next(self.numbers), _thread())
        self._lasting.add(call)
        self.current.call = call
        return call

    def end(self, span: Span | CallSpan, note: str = "") -> None:
        """Record that a span ends; a second end changes nothing."""
        if span.end is None:
            span.end = time.monotonic()
            if note:
                span.note = note[:LONGEST]
            self._ended.append(span)  # first, so that a reader finds the span in both, and never in neither
            self._lasting.discard(span)

    def since(self, start: float) -> ProcessRecord:
        """Return what lasted at `start` (of time.monotonic()) or began later."""
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
            except RuntimeError:  # garbage collection ran another thread, which changed the set or the deque
                continue

    def _complete_from(self) -> float:
        full = len(self._ended) == self._ended.maxlen
        return (self._ended[0].end or 0.0) if full else 0.0


def _transfer_data(transfer: Transfer) -> tuple[str, int, str]:
    (client, port), number, peer = transfer
    return f"{client[0]}:{client[1]}>{port}", number, peer


def _thread() -> Thread:
    thread = threading.current_thread()  # keep only its name, because a server makes a thread for each call
    return thread.name, thread.ident or 0


@cache
def recorder() -> Recorder:
    """Return this process's one recorder, which its hooks write to."""
    return Recorder()
