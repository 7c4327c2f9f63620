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
from functools import cache
from itertools import count
from typing import Any

from course_pkg.graph.tally import Tally

SIZE = 20_000  # marks; some 6 MB when full
LEFT = 50  # records of nodes that have ended
LONGEST = 300  # characters of what is kept of an error's words

Wire = tuple[str, int, str]  # a connection, the number of the message on it, and who is at its other end


class Mark:
    """One thing that happened: `end` is None while it lasts, and `call` ties the parts of one call.

    `wires` says where it went over the network or came from, `asked` over how many connections it was to go.
    """

    __slots__ = ("asked", "call", "end", "kind", "name", "note", "peer", "start", "thread", "wires")

    def __init__(self, kind: str, name: str, peer: str, call: int, wires: list[Wire]) -> None:
        self.kind = kind
        self.name = name
        self.peer = peer
        self.call = call
        self.wires = wires
        self.asked = 0
        self.note = ""
        self.thread = threading.current_thread()
        self.end: float | None = None
        self.start = time.monotonic()

    def as_dict(self) -> dict[str, Any]:
        """Return it as plain data, fit for JSON."""
        return {
            "kind": self.kind,
            "name": self.name,
            "start": self.start,
            "end": self.end,
            "peer": self.peer,
            "call": self.call,
            "wires": list(self.wires),
            "asked": self.asked,
            "note": self.note,
            "thread": [self.thread.name, self.thread.ident or 0],
        }


class _Here(threading.local):
    """What a thread is at: the call that it makes, the messages that it hands to callbacks."""

    call: Any = None
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
        self._over: deque[Mark] = deque(maxlen=size)
        self._lasting: set[Mark] = set()

    def begin(
        self, kind: str, name: str, *, peer: str = "", call: int = 0, wires: list[Wire] | None = None
    ) -> Mark:
        """Take down that something begins."""
        mark = Mark(kind, name, peer, call, [] if wires is None else wires)
        self._lasting.add(mark)
        return mark

    def end(self, mark: Mark, note: str = "") -> None:
        """Take down that it is over; a second end changes nothing."""
        if mark.end is None:
            mark.end = time.monotonic()
            if note:
                mark.note = note[:LONGEST]
            self._over.append(mark)  # first: whoever looks meanwhile finds it in both, and not in neither
            self._lasting.discard(mark)

    def moment(
        self,
        kind: str,
        name: str,
        *,
        peer: str = "",
        call: int = 0,
        wires: list[Wire] | None = None,
        note: str = "",
    ) -> None:
        """Take down something that has no length."""
        mark = Mark(kind, name, peer, call, [] if wires is None else wires)
        mark.end = mark.start
        mark.note = note[:LONGEST]
        self._over.append(mark)

    def since(self, start: float) -> dict[str, Any]:
        """Return what was going on at `start` (of time.monotonic()) or later, as plain data.

        `clock` is the time now, `process` the process id; from `complete_from` on, nothing has been pushed
        out of the ring.
        """
        marks = {id(mark): mark for mark in (*self._lasting.copy(), *self._over.copy())}
        shown = [mark.as_dict() for mark in marks.values() if mark.end is None or mark.end >= start]
        return {
            "clock": time.monotonic(),
            "process": os.getpid(),
            "complete_from": self._complete_from(),
            "blind": sorted(self.blind),
            "marks": shown,
        }

    def _complete_from(self) -> float:
        full = len(self._over) == self._over.maxlen
        return (self._over[0].end or 0.0) if full else 0.0


@cache
def recorder() -> Recorder:
    """Return this process's one recorder, which its taps write to."""
    return Recorder()
