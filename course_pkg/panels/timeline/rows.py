"""Which events stand on which row of their node: a thread keeps its row, and threads share one in turn."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

from course_pkg.graph.events import Event


@dataclass
class _Thread:
    """What one thread of a node did, as numbers of events."""

    numbers: list[int] = field(default_factory=list)
    start: float = math.inf
    end: float = -math.inf

    def take(self, number: int, event: Event) -> None:
        self.numbers.append(number)
        self.start = min(self.start, event.start)
        self.end = max(self.end, _end(event))


def rows_of(events: Sequence[Event]) -> tuple[list[int], list[int]]:
    """Return each event's row on its node, and how many events of its thread it lies within."""
    rows, depths = [0] * len(events), [0] * len(events)
    nodes: dict[str, dict[str, _Thread]] = defaultdict(lambda: defaultdict(_Thread))
    for number, event in enumerate(events):
        nodes[event.node][event.thread].take(number, event)
    for threads in nodes.values():
        free: list[float] = []  # from when on each row is free
        for thread in sorted(threads.values(), key=lambda each: each.start):
            row = next((row for row, end in enumerate(free) if end < thread.start), len(free))
            free[row : row + 1] = [thread.end]
            _place(thread, row, events, rows, depths)
    return rows, depths


def _place(thread: _Thread, row: int, events: Sequence[Event], rows: list[int], depths: list[int]) -> None:
    around: list[float] = []  # the ends of what is going on
    for number in sorted(thread.numbers, key=lambda each: (events[each].start, -_end(events[each]))):
        while around and around[-1] <= events[number].start:
            around.pop()
        rows[number], depths[number] = row, len(around)
        around.append(_end(events[number]))


def _end(event: Event) -> float:
    return math.inf if event.end is None else event.end
