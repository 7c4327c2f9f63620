"""A recording of turtles, as rows that a page can draw and play. This module does not need ROS or Jupyter.

A row begins with a time (ms since the recording began) and a turtle (its index in `names`):

    (ms, turtle, x, y, theta, colour)  the turtle is at x and y (mm) with the angle theta (mrad); the colour
                                       of the line from the previous position is an index in `palette`, or
                                       -1 if there is no line.
    (ms, turtle, "gone")               the turtle has left the simulator.
    (ms, turtle, "undrawn", since)     the turtle has drawn no line since this time, because the pen was up.
    (ms, -1, "cleared")                all lines were erased.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypedDict

from course_pkg.panels.turtles.pen import Colour, Finding, Observation, Pen

Place = tuple[int, int, int, int, int, int]
Change = tuple[int, int, str] | tuple[int, int, str, int]
Row = Place | Change

MOST = 6000  # A recording has at most this many rows, which take about 150 kB in a saved page.
# A new row needs a change of x (mm), y (mm) or theta (mrad) by at least the number in STEP.
STEP = (5, 5, 10)
BACKGROUND: Colour = (69, 86, 255)
UP = -1


class RecordingState(TypedDict):
    """A recording for the page; `length` is in ms."""

    background: Colour
    names: list[str]
    palette: list[Colour]
    rows: list[Row]
    length: int
    edition: int


@dataclass
class _Track:
    """One turtle. `skipped` is its latest position if the turtle has not moved enough for a new row."""

    number: int
    pen: Pen
    last: Place
    skipped: Place | None = None
    known: int = 0  # the last time (ms) at which the state of the pen was certain


@dataclass
class TurtleRecording:
    """The rows of a recording, sorted by time; there are at most `MOST` rows.

    If there are more than `MOST` rows, every second position of each turtle is removed.

    `edition` increases by 1 when rows are removed.
    """

    background: Colour = BACKGROUND
    names: list[str] = field(default_factory=list)
    palette: list[Colour] = field(default_factory=list)
    rows: list[Row] = field(default_factory=list)
    length: int = 0
    edition: int = 0
    _tracks: dict[str, _Track] = field(default_factory=dict)

    def see(self, ms: int, name: str, seen: Observation) -> None:
        """Record the position of a turtle."""
        self.length = max(self.length, ms)
        track = self._tracks.get(name)
        if track is None:
            self._enter(ms, name, seen)
            return
        found = track.pen.observe(seen)
        if found in (Finding.CLEARED, Finding.RESET):
            self._add((ms, UP, "cleared"))
        row = self._row(ms, track, seen, found)
        if found is Finding.UNDRAWN:
            self._add((ms, track.number, "undrawn", track.known))
        if track.pen.sure:
            track.known = ms
        if all(abs(new - old) < step for new, old, step in zip(row[2:5], track.last[2:5], STEP, strict=True)):
            track.skipped = row
            return
        if track.skipped is not None:
            # Add the latest position before the movement, because the turtle was at rest until that time.
            self._add((*track.skipped[:5], UP))
        track.last, track.skipped = row, None
        self._add(row)

    def miss(self, ms: int, name: str) -> None:
        """Record that a turtle has left the simulator."""
        track = self._tracks.pop(name, None)
        if track is not None:
            self.length = max(self.length, ms)
            self._add((ms, track.number, "gone"))

    def state(self) -> RecordingState:
        """Return the recording for the page."""
        return {
            "background": self.background,
            "names": list(self.names),
            "palette": list(self.palette),
            "rows": list(self.rows),
            "length": self.length,
            "edition": self.edition,
        }

    def _enter(self, ms: int, name: str, seen: Observation) -> None:
        if name not in self.names:
            self.names.append(name)
        number, pen = self.names.index(name), Pen(self.background)
        pen.observe(seen)
        last = (ms, number, *_place(seen), UP)
        self._tracks[name] = _Track(number, pen, last, known=ms)
        self._add(last)

    def _row(self, ms: int, track: _Track, seen: Observation, found: Finding) -> Place:
        colour = track.pen.colour
        drawn = colour is not None and found is Finding.NOTHING
        if colour is not None and colour not in self.palette:
            self.palette.append(colour)
        index = self.palette.index(colour) if drawn and colour is not None else UP
        return (ms, track.number, *_place(seen), index)

    def _add(self, row: Row) -> None:
        self.rows.append(row)
        if len(self.rows) > MOST:
            self._thin()

    def _thin(self) -> None:
        kept: list[Row] = []
        turn = dict.fromkeys(range(len(self.names)), 0)
        for row in self.rows:
            if isinstance(row[2], str):
                kept.append(row)
                continue
            turn[row[1]] += 1
            if turn[row[1]] % 2 or row in (track.last for track in self._tracks.values()):
                kept.append(row)
        self.rows = kept
        self.edition += 1


def _place(seen: Observation) -> tuple[int, int, int]:
    return round(seen.x * 1000), round(seen.y * 1000), round(seen.theta * 1000)
