"""Derives the state of a turtle's pen from the turtle's poses and the colour under the turtle.

turtlesim does not publish the state of the pen, or calls of `clear` and `reset`. However, it publishes the
colour of the background or line under the turtle. If the turtle is slow or at rest, the published colour is
the colour of the turtle's own line. A fast turtle is ahead of its own line. The published colour is then the
colour of the background or of an older line.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

Colour = tuple[int, int, int]  # The numbers are red, green and blue, from 0 to 255.

USUAL: Colour = (179, 184, 255)  # Every pen has this colour at the start.
HOME = 5.544444561  # The first turtle starts at this x and y (m).
# Up to the speed `SLOW` (m/s), the turtle is always above the line that it draws. At this speed, the turtle
# moves 0.8 px per tick, and the pen is 3 px wide.
SLOW = 1.1
BRISK = 3.0  # Up to this speed (m/s), the turtle is often above the line that it draws.
STILL = 1e-4  # A turtle is at rest if it moves less than this (m) between two observations.
# The colour is used only after `SETTLED` successive observations at rest, or `SETTLED` successive
# observations in motion.
SETTLED = 2


@dataclass(frozen=True)
class Observation:
    """A turtle at one time: position (m), angle (rad), speed (m/s), and the colour below it, or None."""

    x: float
    y: float
    theta: float
    speed: float
    colour: Colour | None


class Finding(Enum):
    """A conclusion from one observation: whether the pen was up, or the lines were erased."""

    NOTHING = "nothing"
    UNDRAWN = "undrawn"  # The pen has been up since the previous observation.
    CLEARED = "cleared"  # All lines were erased.
    RESET = "reset"  # All lines were erased, and the turtles are in their initial state.


@dataclass
class Pen:
    """The pen of one turtle.

    `colour` is the colour of the pen while the pen is down, and None while the pen is up.

    `sure` is True if the latest observation proved the state of the pen.
    """

    background: Colour
    colour: Colour | None = USUAL
    sure: bool = False
    # `_moved` is True if the turtle has moved since the last change of the pen or deletion of the lines.
    _moved: bool = False
    _still: int = 0  # `_still` is the number of consecutive observations at rest.
    _going: int = 0  # `_going` is the number of consecutive observations in motion.
    _last: Observation | None = None

    def observe(self, seen: Observation) -> Finding:
        """Store the observation `seen`; return the conclusion from this observation."""
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
