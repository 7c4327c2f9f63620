"""Computes the positions of the events in a still picture; scene.js does the same for the page."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.panels.paper import State

HEAD, GAP = 22.0, 12.0  # The height of a node's name, and the distance between the rows of two nodes (px).
# Each tuple in ROWS contains three numbers: a maximum number of rows, the height of a row (px), and the
# distance between rows (px).
ROWS = ((16, 20.0, 3.0), (32, 12.0, 2.0), (52, 8.0, 2.0), (10**9, 4.0, 1.0))
BLOCKED = ("lookup", "connect", "wait")


@dataclass(frozen=True)
class Event:
    """An event with its position in px; `open` means that the event was not finished."""

    number: int
    kind: str
    lane: int
    row: int
    depth: int
    left: float
    right: float
    top: float
    height: float
    open: bool
    name: str
    peer: str
    key: int


class Scene:
    """The events of a recording in a picture that is `width` px wide; times are in µs."""

    def __init__(self, recorded: State, width: float) -> None:
        self.length: int = recorded["length"]
        self.lanes: list[str] = [lane["node"] for lane in recorded["lanes"]]
        room: float = max(self.length * 0.02, 10)
        self._from: float = -room
        self._scale: float = width / (self.length + 2 * room)
        rows = sum(lane["rows"] for lane in recorded["lanes"])
        self._row, self._between = next((high, apart) for most, high, apart in ROWS if rows <= most)
        self.tops: list[float] = []
        y = 4.0
        for lane in recorded["lanes"]:
            self.tops.append(y)
            y += HEAD + lane["rows"] * (self._row + self._between) + GAP
        self.height = max(y - GAP + 8, 40.0)
        self.events = [self._event(number, recorded) for number in range(len(recorded["columns"]["start"]))]
        self.arrows = [(self.events[source], self.events[target]) for source, target in recorded["arrows"]]

    def x(self, time: float) -> float:
        """Return the x coordinate (px) of a time (µs)."""
        return (time - self._from) * self._scale

    def _event(self, number: int, recorded: State) -> Event:
        one = {name: column[number] for name, column in recorded["columns"].items()}
        inset = min(one["depth"] * 3.0, self._row / 2 - 2)
        top = self.tops[one["lane"]] + HEAD + one["row"] * (self._row + self._between) + inset
        end = self.length if one["end"] < 0 else one["end"]
        return Event(
            number=number,
            kind=recorded["kinds"][one["kind"]],
            lane=one["lane"],
            row=one["row"],
            depth=one["depth"],
            left=self.x(max(one["start"], self._from)),
            right=self.x(end),
            top=top,
            height=self._row - 2 * inset,
            open=one["end"] < 0,
            name=recorded["strings"][one["name"]],
            peer=recorded["strings"][one["peer"]],
            key=one["key"],
        )
