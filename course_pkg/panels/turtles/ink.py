"""What a turtle's pen does, as far as poses and the colour under the turtle tell.

Nobody announces a pen, a `clear` or a `reset` on the graph. But the colour sensor reads the paper under the
turtle, and a turtle that moves slowly, or has come to rest, stands on its own line. The faster it is, the
more it reads the paper ahead of its line instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

Colour = tuple[int, int, int]

USUAL: Colour = (179, 184, 255)  # the pen that a turtle begins with
HOME = 5.544444561  # m, where the first turtle begins
SLOW = (
    1.1  # m/s up to which the end of its line certainly reaches under a turtle: 0.8 px a tick, of a pen of 3
)
BRISK = 3.0  # m/s up to which it often does
STILL = 1e-4  # m between two looks
SETTLED = 2  # looks at rest, or on the move, after which the line is under the turtle


@dataclass(frozen=True)
class Sight:
    """A turtle at one look: place (m), angle (rad), speed (m/s), and the colour under it, if known."""

    x: float
    y: float
    theta: float
    speed: float
    colour: Colour | None


class Found(Enum):
    """What a look has shown beyond the movement."""

    NOTHING = "nothing"
    UNDRAWN = "undrawn"  # the pen was up on the way here
    WIPED = "wiped"  # the paper is new
    BEGUN = "begun"  # the world is new: a reset


@dataclass
class Ink:
    """The pen of one turtle: `colour` while it is down, None while it is up.

    `sure` says whether the last look has shown what the pen does.
    """

    background: Colour
    colour: Colour | None = USUAL
    sure: bool = False
    _moved: bool = False  # since the paper or the pen was new
    _still: int = 0  # looks at rest in a row
    _going: int = 0  # looks on the move in a row
    _last: Sight | None = None

    def look(self, sight: Sight) -> Found:
        """Take in a look; say what it has shown."""
        last, self._last = self._last, sight
        self.sure = False
        if last is None:
            return Found.NOTHING
        moving = abs(sight.x - last.x) + abs(sight.y - last.y) > STILL
        self._still, self._going = (0, self._going + 1) if moving else (self._still + 1, 0)
        self._moved = self._moved or moving
        if sight.colour is None:
            return Found.NOTHING
        if moving and self._sent_home(sight):
            self.colour, self._moved = USUAL, False
            return Found.BEGUN
        if not moving and self._still > 1 and self._paper_changed(last, sight):
            self._moved = False
            return Found.WIPED
        return self._read(last, sight, moving)

    def _read(self, last: Sight, sight: Sight, moving: bool) -> Found:
        """Learn what the pen does from a colour that two looks in a row have shown."""
        plain = sight.colour == self.background
        near = not moving or sight.speed <= (SLOW if plain else BRISK)
        settled = max(self._still, self._going) >= SETTLED
        if not (self._moved and near and settled and sight.colour == last.colour):
            return Found.NOTHING
        before, self.colour, self.sure = self.colour, None if plain else sight.colour, True
        return Found.UNDRAWN if plain and before is not None else Found.NOTHING

    def _paper_changed(self, last: Sight, sight: Sight) -> bool:
        return sight.colour == self.background and last.colour not in (None, self.background)

    def _sent_home(self, sight: Sight) -> bool:
        home = abs(sight.x - HOME) < 1e-6 and abs(sight.y - HOME) < 1e-6 and sight.theta == 0.0
        return home and sight.speed == 0.0 and sight.colour == self.background
