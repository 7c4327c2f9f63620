"""Derives the state of a turtle's pen from its poses and from the colour under the turtle.

turtlesim publishes neither the state of the pen nor calls of `clear` and `reset`. But it publishes the colour
of the background or the line under the turtle. Under a slow turtle, or one that does not move, this is the
colour of its own line. Under a fast turtle, this is the colour in front of its line.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

Colour = tuple[int, int, int]  # red, green, blue

USUAL: Colour = (179, 184, 255)  # the colour of every pen at the start
HOME = 5.544444561  # m, x and y of the first turtle at the start
# Up to this speed (m/s), the line always reaches under the turtle: the turtle moves 0.8 px per tick, and the
# pen is 3 px wide.
SLOW = 1.1
BRISK = 3.0  # m/s; up to this speed, the line often reaches under the turtle
STILL = 1e-4  # m; a turtle that moves less between two observations is at rest
# number of successive observations, all at rest or all moving, after which the line is under the turtle
SETTLED = 2


@dataclass(frozen=True)
class Observation:
    """A turtle at one time: position (m), angle (rad), speed (m/s), and the colour under it, if known."""

    x: float
    y: float
    theta: float
    speed: float
    colour: Colour | None


class Finding(Enum):
    """What an observation tells about the pen and the paper."""

    NOTHING = "nothing"
    UNDRAWN = "undrawn"  # the pen was up since the previous observation
    CLEARED = "cleared"  # the paper is empty again
    RESET = "reset"  # the paper is empty, and the turtles are in their initial state


@dataclass
class Pen:
    """The pen of one turtle; `colour` is None while the pen is up.

    `colour` is its colour while it is down, and None while it is up.

    `sure` says whether the latest observation proved the state of the pen.
    """

    background: Colour
    colour: Colour | None = USUAL
    sure: bool = False
    _moved: bool = False  # whether the turtle has moved since the paper or the pen was new
    _still: int = 0  # number of consecutive observations at rest
    _going: int = 0  # number of consecutive observations in motion
    _last: Observation | None = None

    def observe(self, seen: Observation) -> Finding:
        """Store an observation, and return what it tells about the pen and the paper."""
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
        """Derive the state of the pen from two successive observations with the same colour."""
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
