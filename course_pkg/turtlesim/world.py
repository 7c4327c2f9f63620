"""The world of the turtles: their positions and motion, and the lines of their pens.

This module does not need ROS.

Lengths are in metres. The world is 11.088889 m wide and high, and its origin is at the bottom left. Angles
are in radians, counter-clockwise from the x-axis. One tick is 16 ms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import count

from course_pkg.turtlesim.canvas import SIDE, Canvas, Colour, Point

TICK = 0.016  # A tick has this length in s.
# A metre has this number of pixels. In ROS's own turtlesim, this number is the height of a turtle's picture.
PIXELS = 45.0
WIDTH = (SIDE - 1) / PIXELS  # The world has this width and height in m.
HOME = WIDTH / 2  # The middle of the world has this x and y in m.
COMMAND_TIMEOUT = 1.0  # A velocity command is valid for this time in s.
BACKGROUND: Colour = (69, 86, 255)


class NameTaken(Exception):
    """A turtle with this name already exists."""


class UnknownTurtle(Exception):
    """No turtle has this name."""


@dataclass(frozen=True)
class Pen:
    """The pen of a turtle: its colour, its width in px, and whether it draws."""

    colour: Colour = (179, 184, 255)
    width: int = 3
    down: bool = True


@dataclass(frozen=True)
class Velocity:
    """A velocity command: forwards and sideways in m/s, and the rotation in rad/s.

    `since` is the time in s at which the command arrived, on the same clock as in World.tick().
    """

    forward: float = 0.0
    sideways: float = 0.0
    turn: float = 0.0
    since: float = -math.inf


@dataclass
class Turtle:
    """One turtle.

    Any thread may set `velocity`. Only the world's thread sets all other attributes. All other attributes are
    set only by the world's thread.
    """

    name: str
    x: float = HOME
    y: float = HOME
    theta: float = 0.0
    pen: Pen = field(default_factory=Pen)
    velocity: Velocity = field(default_factory=Velocity)
    colour: Colour = BACKGROUND  # This is the colour of the canvas under the turtle.

    @property
    def speed(self) -> float:
        """The turtle's speed in m/s, in any direction."""
        return math.hypot(self.velocity.forward, self.velocity.sideways)

    @property
    def point(self) -> Point:
        """The turtle's position on the canvas in px."""
        return self.x * PIXELS, (WIDTH - self.y) * PIXELS

    def teleport(self, canvas: Canvas, x: float, y: float, theta: float) -> None:
        """Move to (x, y) at once, and draw a line if the pen is down.

        A position above the world is moved to the upper edge.
        """
        before = self.point
        self.x, self.y, self.theta = x, min(y, WIDTH), theta
        self._draw(canvas, before)

    def teleport_relative(self, canvas: Canvas, distance: float, angle: float) -> None:
        """Turn by the angle `angle` (rad), and then move forward by `distance` (m) at once."""
        before = self.point
        self.theta += angle
        self.x += math.cos(self.theta) * distance
        self.y += math.sin(self.theta) * distance
        self._draw(canvas, before)

    def tick(self, canvas: Canvas, now: float) -> str:
        """Move for 16 ms; return a warning if the turtle hits the wall, else ""."""
        if now - self.velocity.since > COMMAND_TIMEOUT:
            self.velocity = replace(self.velocity, forward=0.0, sideways=0.0, turn=0.0)
        before, velocity = self.point, self.velocity
        self.theta = normalized(self.theta + velocity.turn * TICK)
        ahead, aside = velocity.forward * TICK, velocity.sideways * TICK
        self.x += math.cos(self.theta) * ahead - math.sin(self.theta) * aside
        self.y += math.sin(self.theta) * ahead + math.cos(self.theta) * aside
        warning = self._stay_inside()
        self.colour = canvas.colour_at(self.point)
        if self.point != before:
            self._draw(canvas, before)
        return warning

    def _stay_inside(self) -> str:
        x, y = self.x, self.y
        self.x, self.y = (min(max(each, 0.0), WIDTH) for each in (x, y))
        if (x, y) == (self.x, self.y):
            return ""
        return f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])"

    def _draw(self, canvas: Canvas, before: Point) -> None:
        if self.pen.down:
            canvas.line(_near_canvas(self.point), _near_canvas(before), self.pen.colour, self.pen.width)


class World:
    """All turtles, and the canvas on which they draw. A new world has `turtle1` in the middle."""

    def __init__(self, background: Colour = BACKGROUND) -> None:
        self.canvas = Canvas(background)
        self.turtles: dict[str, Turtle] = {}
        self._numbers = count(1)
        self.spawn(HOME, HOME, 0.0)

    def spawn(self, x: float, y: float, theta: float, name: str = "") -> Turtle:
        """Add a turtle, and return it. Raises NameTaken if a turtle with this name exists.

        Without `name`, the turtle gets the first free name of turtle1, turtle2, ….
        """
        return self.add(self.make(x, y, theta, name))

    def make(self, x: float, y: float, theta: float, name: str = "") -> Turtle:
        """Return a new turtle that is not in the world yet.

        Raises NameTaken if another turtle uses this name.
        """
        name = name or self._free_name()
        if name in self.turtles:
            raise NameTaken(f"A turtled named [{name}] already exists")
        return Turtle(name, x, y, theta)

    def add(self, turtle: Turtle) -> Turtle:
        """Add a turtle to the world."""
        self.turtles[turtle.name] = turtle
        return turtle

    def kill(self, name: str) -> Turtle:
        """Remove a turtle from the world, and return it; the lines that it has drawn remain.

        Raises UnknownTurtle if no turtle has this name.
        """
        if name not in self.turtles:
            raise UnknownTurtle(f"Tried to kill turtle [{name}], which does not exist")
        return self.turtles.pop(name)

    def clear(self, background: Colour) -> None:
        """Erase all lines, and give the canvas the colour `background`."""
        self.canvas.fill(background)

    def reset(self, background: Colour) -> None:
        """Reset the world to turtle1 in the middle and an empty canvas."""
        self.turtles.clear()
        self._numbers = count(1)
        self.spawn(HOME, HOME, 0.0)
        self.clear(background)

    def tick(self, now: float) -> list[str]:
        """Move every turtle for 16 ms, and return the warnings; `now` is the current time in s."""
        warnings = [self.turtles[name].tick(self.canvas, now) for name in sorted(self.turtles)]
        return [warning for warning in warnings if warning]

    def _free_name(self) -> str:
        return next(
            name for name in (f"turtle{number}" for number in self._numbers) if name not in self.turtles
        )


def all_finite(*numbers: float) -> bool:
    """Return whether all numbers are finite."""
    return all(map(math.isfinite, numbers))


def normalized(angle: float) -> float:
    """Return an angle for the same direction, from -π (included) to π (not included)."""
    return angle - 2 * math.pi * math.floor((angle + math.pi) / (2 * math.pi))


def _near_canvas(point: Point) -> Point:
    """Return the point, or a nearer point if the point is far from the canvas.

    A nearer point limits the time for drawing a line.
    """
    x, y = (min(max(each, -2.0 * SIDE), 3.0 * SIDE) for each in point)
    return x, y
