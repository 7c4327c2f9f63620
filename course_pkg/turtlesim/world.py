"""The turtles' world: where they are, how they move, what their pens draw. No ROS.

Lengths are metres, of which the world is 11.088889 wide and high, the origin at the bottom left. Angles are
radians, counter-clockwise from the x-axis. One tick is 16 ms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import count

from course_pkg.turtlesim.paper import SIDE, Colour, Paper, Point

TICK = 0.016  # s
PIXELS = 45.0  # px for a metre: the height of the picture of a turtle
WIDTH = (SIDE - 1) / PIXELS  # m
HOME = WIDTH / 2
OBEDIENCE = 1.0  # s that a velocity holds
BACKGROUND: Colour = (69, 86, 255)


class NameTaken(Exception):
    """A turtle of this name is there already."""


class UnknownTurtle(Exception):
    """No turtle has this name."""


@dataclass(frozen=True)
class Pen:
    """What a turtle draws with."""

    colour: Colour = (179, 184, 255)
    width: int = 3
    down: bool = True


@dataclass(frozen=True)
class Velocity:
    """What a turtle was told: m/s forwards and sideways, rad/s; `since` is when (s, any clock)."""

    forward: float = 0.0
    sideways: float = 0.0
    turn: float = 0.0
    since: float = -math.inf


@dataclass
class Turtle:
    """One turtle; `velocity` may be set from any thread, all else by the world's own."""

    name: str
    x: float = HOME
    y: float = HOME
    theta: float = 0.0
    pen: Pen = field(default_factory=Pen)
    velocity: Velocity = field(default_factory=Velocity)
    colour: Colour = BACKGROUND  # of the paper under it

    @property
    def speed(self) -> float:
        """How fast it goes, whichever way (m/s)."""
        return math.hypot(self.velocity.forward, self.velocity.sideways)

    @property
    def point(self) -> Point:
        """Where it is on the paper (px)."""
        return self.x * PIXELS, (WIDTH - self.y) * PIXELS

    def teleport(self, paper: Paper, x: float, y: float, theta: float) -> None:
        """Go there at once, drawing a line as the pen says; a y above the world is its upper edge."""
        before = self.point
        self.x, self.y, self.theta = x, min(y, WIDTH), theta
        self._draw(paper, before)

    def leap(self, paper: Paper, distance: float, angle: float) -> None:
        """Turn by `angle`, then go `distance` at once."""
        before = self.point
        self.theta += angle
        self.x += math.cos(self.theta) * distance
        self.y += math.sin(self.theta) * distance
        self._draw(paper, before)

    def tick(self, paper: Paper, now: float) -> str:
        """Move for 16 ms; return what there is to warn of, or ""."""
        if now - self.velocity.since > OBEDIENCE:
            self.velocity = replace(self.velocity, forward=0.0, sideways=0.0, turn=0.0)
        before, velocity = self.point, self.velocity
        self.theta = wrapped(self.theta + velocity.turn * TICK)
        ahead, aside = velocity.forward * TICK, velocity.sideways * TICK
        self.x += math.cos(self.theta) * ahead - math.sin(self.theta) * aside
        self.y += math.sin(self.theta) * ahead + math.cos(self.theta) * aside
        warning = self._stay_inside()
        self.colour = paper.colour_at(self.point)
        if self.point != before:
            self._draw(paper, before)
        return warning

    def _stay_inside(self) -> str:
        x, y = self.x, self.y
        self.x, self.y = (min(max(each, 0.0), WIDTH) for each in (x, y))
        if (x, y) == (self.x, self.y):
            return ""
        return f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])"

    def _draw(self, paper: Paper, before: Point) -> None:
        if self.pen.down:
            paper.line(_on_paper(self.point), _on_paper(before), self.pen.colour, self.pen.width)


class World:
    """All turtles and the paper they draw on. It begins with `turtle1` in the middle."""

    def __init__(self, background: Colour = BACKGROUND) -> None:
        self.paper = Paper(background)
        self.turtles: dict[str, Turtle] = {}
        self._numbers = count(1)
        self.spawn(HOME, HOME, 0.0)

    def spawn(self, x: float, y: float, theta: float, name: str = "") -> Turtle:
        """Add a turtle, with the next free name of turtle1, turtle2, … if it is given none."""
        return self.add(self.make(x, y, theta, name))

    def make(self, x: float, y: float, theta: float, name: str = "") -> Turtle:
        """Return a turtle that is to be added, with a name that is free."""
        name = name or self._free_name()
        if name in self.turtles:
            raise NameTaken(f"A turtled named [{name}] already exists")
        return Turtle(name, x, y, theta)

    def add(self, turtle: Turtle) -> Turtle:
        """Have a turtle in the world, from now on."""
        self.turtles[turtle.name] = turtle
        return turtle

    def kill(self, name: str) -> Turtle:
        """Take a turtle out of the world; what it drew stays."""
        if name not in self.turtles:
            raise UnknownTurtle(f"Tried to kill turtle [{name}], which does not exist")
        return self.turtles.pop(name)

    def clear(self, background: Colour) -> None:
        """Take new paper."""
        self.paper.fill(background)

    def reset(self, background: Colour) -> None:
        """Begin anew, with new paper and one turtle."""
        self.turtles.clear()
        self._numbers = count(1)
        self.spawn(HOME, HOME, 0.0)
        self.clear(background)

    def tick(self, now: float) -> list[str]:
        """Move every turtle for 16 ms; return what there is to warn of."""
        warnings = [self.turtles[name].tick(self.paper, now) for name in sorted(self.turtles)]
        return [warning for warning in warnings if warning]

    def _free_name(self) -> str:
        return next(
            name for name in (f"turtle{number}" for number in self._numbers) if name not in self.turtles
        )


def sound(*numbers: float) -> bool:
    """Whether all of them are numbers that a turtle can be at or move by."""
    return all(map(math.isfinite, numbers))


def wrapped(angle: float) -> float:
    """Return the same direction from -π (included) to π."""
    return angle - 2 * math.pi * math.floor((angle + math.pi) / (2 * math.pi))


def _on_paper(point: Point) -> Point:
    """Return the point, or the nearest not far off the paper: a line to the moon takes no time to draw."""
    x, y = (min(max(each, -2.0 * SIDE), 3.0 * SIDE) for each in point)
    return x, y
