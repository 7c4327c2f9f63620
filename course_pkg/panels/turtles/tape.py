"""What turtles did, as rows that a page can draw and replay. Knows neither ROS nor Jupyter.

A row is a list. First come a time (ms since the tape began) and a turtle (its place in `names`):

    [ms, turtle, x, y, theta, ink]   it is there: mm, mm, mrad; the ink (its place in `palette`) of the way
                                     here from its row before, or -1 where nothing was drawn
    [ms, turtle, "gone"]             it has left
    [ms, turtle, "undrawn", since]   on its way since that time its pen was up after all
    [ms, -1, "wiped"]                the paper is new
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from course_pkg.panels.turtles.ink import Colour, Found, Ink, Sight

Row = list[Any]

MOST = 6000  # rows; 150 KB when saved
STEP = (5, 5, 10)  # mm, mm, mrad that are worth a row
BACKGROUND: Colour = (69, 86, 255)
UP = -1


@dataclass
class _Track:
    """One turtle: its pen, its last row, and where it stood at the look before, if that made no row."""

    number: int
    ink: Ink
    last: Row
    skipped: Row | None = None
    known: int = 0  # ms, when it was last sure what its pen does


@dataclass
class Tape:
    """Rows in order of time, at most MOST of them: then every other place of a turtle is left out.

    `edition` is counted up whenever earlier rows have changed.
    """

    background: Colour = BACKGROUND
    names: list[str] = field(default_factory=list)
    palette: list[Colour] = field(default_factory=list)
    rows: list[Row] = field(default_factory=list)
    length: int = 0
    edition: int = 0
    _tracks: dict[str, _Track] = field(default_factory=dict)

    def see(self, ms: int, name: str, sight: Sight) -> None:
        """Note where a turtle is."""
        self.length = max(self.length, ms)
        track = self._tracks.get(name)
        if track is None:
            self._enter(ms, name, sight)
            return
        found = track.ink.look(sight)
        if found in (Found.WIPED, Found.BEGUN):
            self._add([ms, UP, "wiped"])
        row = self._row(ms, track, sight, found)
        if found is Found.UNDRAWN:
            self._add([ms, track.number, "undrawn", track.known])
        if track.ink.sure:
            track.known = ms
        if all(abs(new - old) < step for new, old, step in zip(row[2:5], track.last[2:5], STEP, strict=True)):
            track.skipped = row
            return
        if track.skipped is not None:
            self._add([*track.skipped[:5], UP])  # it stood still until then
        track.last, track.skipped = row, None
        self._add(row)

    def miss(self, ms: int, name: str) -> None:
        """Note that a turtle has left."""
        track = self._tracks.pop(name, None)
        if track is not None:
            self.length = max(self.length, ms)
            self._add([ms, track.number, "gone"])

    def state(self) -> dict[str, Any]:
        """Return all of it as plain data."""
        return {
            "background": list(self.background),
            "names": list(self.names),
            "palette": [list(colour) for colour in self.palette],
            "rows": list(self.rows),
            "length": self.length,
            "edition": self.edition,
        }

    def _enter(self, ms: int, name: str, sight: Sight) -> None:
        if name not in self.names:
            self.names.append(name)
        track = _Track(self.names.index(name), Ink(self.background), [], known=ms)
        track.ink.look(sight)
        track.last = [ms, track.number, *_place(sight), UP]
        self._tracks[name] = track
        self._add(track.last)

    def _row(self, ms: int, track: _Track, sight: Sight, found: Found) -> Row:
        colour = track.ink.colour
        drawn = colour is not None and found is Found.NOTHING
        if colour is not None and colour not in self.palette:
            self.palette.append(colour)
        ink = self.palette.index(colour) if drawn and colour is not None else UP
        return [ms, track.number, *_place(sight), ink]

    def _add(self, row: Row) -> None:
        self.rows.append(row)
        if len(self.rows) > MOST:
            self._thin()

    def _thin(self) -> None:
        kept, turn = [], dict.fromkeys(range(len(self.names)), 0)
        for row in self.rows:
            if isinstance(row[2], str):
                kept.append(row)
                continue
            turn[row[1]] += 1
            if turn[row[1]] % 2 or row in (track.last for track in self._tracks.values()):
                kept.append(row)
        self.rows = kept
        self.edition += 1


def _place(sight: Sight) -> tuple[int, int, int]:
    return round(sight.x * 1000), round(sight.y * 1000), round(sight.theta * 1000)
