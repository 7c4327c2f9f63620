"""What a turtle's pen does, as far as poses and the colour under the turtle show it.

turtlesim publishes no pen, no `clear` and no `reset`. But its colour sensor reads the paper under the
turtle, and a turtle that moves slowly or stands is on its own line. A fast turtle reads the paper ahead of
its line.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

Colour = tuple[int, int, int]  # red, green, blue

USUAL: Colour = (179, 184, 255)  # the pen that a turtle begins with
HOME = 5.544444561  # m, where the first turtle begins
# Up to this speed (m/s) the line always reaches under the turtle: 0.8 px a tick, with a pen of 3 px.
SLOW = 1.1
BRISK = 3.0  # m/s; up to this speed it often does
STILL = 1e-4  # m between two observations
SETTLED = 2  # observations at rest, or moving, after which the line is under the turtle


@dataclass(frozen=True)
class Observation:
    """A turtle at one time: place (m), angle (rad), speed (m/s), and the colour under it, if known."""

    x: float
    y: float
    theta: float
    speed: float
    colour: Colour | None


class Finding(Enum):
    """What an observation shows beyond the movement."""

    NOTHING = "nothing"
    UNDRAWN = "undrawn"  # the pen was up since the observation before
    CLEARED = "cleared"  # the paper is new
    RESET = "reset"  # the paper and the turtles are new


@dataclass
class Pen:
    """The pen of one turtle: `colour` while it is down, None while it is up.

    `sure` is whether the last observation showed what the pen does.
    """

    background: Colour
    colour: Colour | None = USUAL
    sure: bool = False
    _moved: bool = False  # since the paper or the pen was new
    _still: int = 0  # observations at rest in a row
    _going: int = 0  # moving observations in a row
    _last: Observation | None = None

    def observe(self, seen: Observation) -> Finding:
        """Take in an observation, and return what it shows."""
        last, self._last = self._last, seen
        self.sure = False
        if last is None:
            return Finding.NOTHING
        moving = abs(seen.x - last.x) + abs(seen.y - last.y) > STILL
        self._still, self._going = (0, self._going + 1) if moving else (self._still + 1, 0)
        self._moved = self._moved or moving
        if seen.colour is None:
            return Finding.NOTHING
        if moving and self._sent_home(seen):
            self.colour, self._moved = USUAL, False
            return Finding.RESET
        if not moving and self._still > 1 and self._paper_changed(last, seen):
            self._moved = False
            return Finding.CLEARED
        return self._read(last, seen, moving)

    def _read(self, last: Observation, seen: Observation, moving: bool) -> Finding:
        """Find out what the pen does from a colour that two observations in a row show."""
        plain = seen.colour == self.background
        near = not moving or seen.speed <= (SLOW if plain else BRISK)
        settled = max(self._still, self._going) >= SETTLED
        if not (self._moved and near and settled and seen.colour == last.colour):
            return Finding.NOTHING
        before, self.colour, self.sure = self.colour, None if plain else seen.colour, True
        return Finding.UNDRAWN if plain and before is not None else Finding.NOTHING

    def _paper_changed(self, last: Observation, seen: Observation) -> bool:
        return seen.colour == self.background and last.colour not in (None, self.background)

    def _sent_home(self, seen: Observation) -> bool:
        home = abs(seen.x - HOME) < 1e-6 and abs(seen.y - HOME) < 1e-6 and seen.theta == 0.0
        return home and seen.speed == 0.0 and seen.colour == self.background
