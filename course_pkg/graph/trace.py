"""The flight recorder of a process: what its node did lately, in a ring of bounded size.

Times are those of time.monotonic(). On Linux that is CLOCK_MONOTONIC, one clock for all processes of a
machine: https://docs.python.org/3/library/time.html#time.monotonic ("system-wide") and clock_gettime(2). So
the times of several nodes can be put beside each other. This module knows no rospy; `service_taps` and
`topic_taps` tell it what happens there.
"""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Sequence
from functools import cache
from itertools import count
from typing import Any

from course_pkg.graph.events import ERROR, LOOKUP, MASTER, REQUEST, RESPONSE, WAIT
from course_pkg.graph.tally import Tally

SIZE = 20_000  # marks; some 6 MB when full
LEFT = 50  # records of nodes that have ended
LONGEST = 300  # characters of what is kept of an error's words

END = 2  # the place of the end in a part of a call
EXCHANGED = (REQUEST, WAIT, RESPONSE)  # the parts of a call that go over the connection

Connection = tuple[
    Sequence[Any], int
]  # as both ends know it: the client's numeric address, the server's port
Wire = tuple[Connection, int, str]  # the number of the message on the connection, and who is at its other end
Thread = tuple[str, int]  # its name, and its number while it lives


class Mark:
    """One thing that happened: `end` is None while it lasts.

    `wires` says where it went over the network or came from, `asked` over how many connections it was to go.
    """

    __slots__ = ("asked", "end", "kind", "name", "note", "peer", "start", "thread", "wires")

    def __init__(self, kind: str, name: str, peer: str, wires: list[Wire], thread: Thread) -> None:
        self.kind = kind
        self.name = name
        self.peer = peer
        self.wires = wires
        self.thread = thread
        self.asked = 0
        self.note = ""
        self.end: float | None = None
        self.start = time.monotonic()

    def told(self) -> list[dict[str, Any]]:
        """Return it as plain data, fit for JSON."""
        return [
            {
                "kind": self.kind,
                "name": self.name,
                "start": self.start,
                "end": self.end,
                "peer": self.peer,
                "call": 0,
                "wires": [_told_wire(wire) for wire in list(self.wires)],
                "asked": self.asked,
                "note": self.note,
                "thread": list(self.thread),
            }
        ]


class CallMark:
    """A call with all its parts, each [kind, start, end or None]: one mark, since calls have to stay quick.

    `settled` is how it ended, RESPONSE or ERROR, and `wire` is where its request went.
    """

    __slots__ = (
        "answered",
        "end",
        "name",
        "note",
        "number",
        "parts",
        "peer",
        "settled",
        "start",
        "thread",
        "wire",
    )

    def __init__(self, name: str, number: int, thread: Thread) -> None:
        self.name = name
        self.number = number
        self.thread = thread
        self.parts: list[list[Any]] = []
        self.peer = ""
        self.note = ""
        self.settled = ""
        self.answered = False
        self.wire: Wire | None = None
        self.end: float | None = None
        self.start = time.monotonic()

    def begin(self, kind: str) -> list[Any]:
        """Take down that a part begins, and return it; its END is to be set when it is over."""
        part = [kind, time.monotonic(), None]
        self.parts.append(part)
        return part

    def settle(self, kind: str, note: str = "", *, answered: bool = True) -> None:
        """Take down how the call ended, and when; an error may be the server's answer or not."""
        now = time.monotonic()
        self.parts.append([kind, now, now])
        self.settled = kind
        self.answered = answered
        self.note = note[:LONGEST]

    def told(self) -> list[dict[str, Any]]:
        """Return its parts as plain data, fit for JSON."""
        return [self._told(*part) for part in list(self.parts)]

    def _told(self, kind: str, start: float, end: float | None) -> dict[str, Any]:
        unanswered = kind == ERROR and not self.answered
        return {
            "kind": kind,
            "name": self.name,
            "start": start,
            "end": end,
            "peer": MASTER if kind == LOOKUP else "" if unanswered else self.peer,
            "call": self.number,
            "wires": [_told_wire(self.wire)] if self.wire is not None and kind in EXCHANGED else [],
            "asked": 0,
            "note": self.note if kind == self.settled else "",
            "thread": list(self.thread),
        }


class _Here(threading.local):
    """What a thread is at: the call that it makes, the messages that it hands to callbacks."""

    call: CallMark | None = None
    batch: Any = None


class Recorder:
    """The marks of this process: the last 20,000 that are over, and all that last.

    Threads may share it: each step is one operation of a set or a deque, which the interpreter does not part.
    """

    def __init__(self, size: int = SIZE) -> None:
        self.tally = Tally()
        self.blind: set[str] = set()  # what cannot be seen in this process, in words
        self.here = _Here()
        self.recordings = 0  # that are being made in this process
        self.left: deque[tuple[str, dict[str, Any]]] = deque(maxlen=LEFT)  # by nodes that ended meanwhile
        self.numbers = count(1)
        self._over: deque[Mark | CallMark] = deque(maxlen=size)
        self._lasting: set[Mark | CallMark] = set()

    def begin(self, kind: str, name: str, peer: str, wires: list[Wire]) -> Mark:
        """Take down that something begins."""
        mark = Mark(kind, name, peer, wires, _thread())
        self._lasting.add(mark)
        return mark

    def begin_call(self, name: str) -> CallMark:
        """Take down that this thread begins a call."""
        call = CallMark(name, next(self.numbers), _thread())
        self._lasting.add(call)
        self.here.call = call
        return call

    def end(self, mark: Mark | CallMark, note: str = "") -> None:
        """Take down that it is over; a second end changes nothing."""
        if mark.end is None:
            mark.end = time.monotonic()
            if note:
                mark.note = note[:LONGEST]
            self._over.append(mark)  # first: whoever looks meanwhile finds it in both, and not in neither
            self._lasting.discard(mark)

    def since(self, start: float) -> dict[str, Any]:
        """Return what was going on at `start` (of time.monotonic()) or later, as plain data.

        `clock` is the time now, `process` the process id; from `complete_from` on, nothing has been pushed
        out of the ring.
        """
        late = [mark for mark in self._marks() if mark.end is None or mark.end >= start]
        return {
            "clock": time.monotonic(),
            "process": os.getpid(),
            "complete_from": self._complete_from(),
            "blind": sorted(self.blind),
            "marks": [told for mark in late for told in mark.told()],
        }

    def _marks(self) -> list[Mark | CallMark]:
        while True:
            try:
                return list({id(mark): mark for mark in (*self._lasting.copy(), *self._over.copy())}.values())
            except (
                RuntimeError
            ):  # another thread came in between, because memory was being tidied up just then
                continue

    def _complete_from(self) -> float:
        full = len(self._over) == self._over.maxlen
        return (self._over[0].end or 0.0) if full else 0.0


def _told_wire(wire: Wire) -> list[Any]:
    (client, port), number, peer = wire
    return [f"{client[0]}:{client[1]}>{port}", number, peer]


def _thread() -> Thread:
    thread = threading.current_thread()  # which is not kept itself: a server has one for each call
    return thread.name, thread.ident or 0


@cache
def recorder() -> Recorder:
    """Return this process's one recorder, which its taps write to."""
    return Recorder()
