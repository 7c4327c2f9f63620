"""Tests of the simulated turtle world without ROS."""

from __future__ import annotations

import math
import struct
import time

import pytest

from course_pkg.turtlesim.canvas import SIDE, Canvas, Point
from course_pkg.turtlesim.world import (
    BACKGROUND,
    HOME,
    TICK,
    WIDTH,
    NameTaken,
    Pen,
    Turtle,
    UnknownTurtle,
    Velocity,
    World,
    normalized,
)

GROUND, LINE = (69, 86, 255), (1, 2, 3)


def run(world: World, ticks: int, start: float = 0.0) -> list[str]:
    """Run several ticks, and return all warnings."""
    return [warning for tick in range(ticks) for warning in world.tick(start + tick * TICK)]


def driven(forward: float = 0.0, sideways: float = 0.0, turn: float = 0.0) -> tuple[World, Turtle]:
    """Return a world, and its turtle with the given velocity."""
    world = World()
    turtle = world.turtles["turtle1"]
    turtle.velocity = Velocity(forward, sideways, turn, since=0.0)
    return world, turtle


def float32(value: float) -> float:
    """Return a number, rounded to a float32."""
    (kept,) = struct.unpack("<f", struct.pack("<f", value))
    return float(kept)


def test_the_first_turtle_is_in_the_middle() -> None:
    """turtle1 starts at 5.544444561004639 m in x and y (as a float32)."""
    turtle = World().turtles["turtle1"]
    assert (float32(turtle.x), float32(turtle.y)) == (5.544444561004639, 5.544444561004639)
    assert (turtle.theta, round(WIDTH, 6)) == (0.0, 11.088889)


def test_a_velocity_is_valid_for_a_second() -> None:
    """A velocity of 1 m/s drives the turtle for one second, and moves the turtle by 1.008 m."""
    world, turtle = driven(forward=1.0)
    world.tick(0.0)
    assert turtle.x - HOME == pytest.approx(0.016)
    run(world, 200, start=TICK)
    assert turtle.x - HOME == pytest.approx(1.008)
    assert turtle.speed == 0.0


def test_an_arc() -> None:
    """A velocity of (2 m/s, 1.8 rad/s) turns the turtle by 1.8144 rad."""
    world, turtle = driven(forward=2.0, turn=1.8)
    run(world, 100)
    assert turtle.theta == pytest.approx(1.8144)
    radius = 2.0 / 1.8
    ideal = HOME + radius * math.sin(1.8144), HOME + radius * (1 - math.cos(1.8144))
    assert math.dist(ideal, (turtle.x, turtle.y)) == pytest.approx(0.0155, abs=0.012)


def test_sideways() -> None:
    """linear.y moves the turtle sideways, and the pose contains the length of the velocity vector."""
    world, turtle = driven(forward=3.0, sideways=-4.0)
    world.tick(0.0)
    assert (turtle.x - HOME, turtle.y - HOME) == (pytest.approx(0.048), pytest.approx(-0.064))
    assert turtle.speed == 5.0


def test_the_wall() -> None:
    """At the wall, the turtle does not move any further, and each tick returns a warning."""
    world, turtle = driven(forward=1000.0)
    warnings = run(world, 3)
    assert turtle.x == WIDTH
    assert turtle.speed == 1000.0
    assert warnings[0] == f"Oh no! I hit the wall! (Clamping from [x={HOME + 16:f}, y={HOME:f}])"
    assert len(warnings) == 3


@pytest.mark.parametrize(
    ("angle", "read"), [(math.pi, -3.141593), (-math.pi, 3.141593), (7.0, 0.716815), (-4.0, 2.283185), (0, 0)]
)
def test_theta_is_normalized(angle: float, read: float) -> None:
    """normalized() returns an angle from -π to π.

    The float32 nearest to π becomes -3.141593, and the float32 nearest to -π becomes 3.141593.
    """
    assert round(normalized(float32(angle)), 6) == read


def test_spawn_outside_is_clamped() -> None:
    """A turtle that is spawned outside the world is at the wall after one tick."""
    world = World()
    turtle = world.spawn(-3.0, 99.0, 0.0, "far")
    assert len(world.tick(0.0)) == 1
    assert (turtle.x, turtle.y) == (0.0, WIDTH)


def test_a_turtle_without_a_name_gets_one() -> None:
    """If a turtle has no name, its name is turtle2, turtle3 and so on; no name is used twice."""
    world = World()
    world.spawn(1, 1, 0, "turtle3")
    assert [world.spawn(1, 1, 0).name for _ in range(2)] == ["turtle2", "turtle4"]
    world.kill("turtle4")
    assert world.spawn(1, 1, 0).name == "turtle5"
    world.reset(BACKGROUND)
    assert sorted(world.turtles) == ["turtle1"]
    assert world.spawn(1, 1, 0).name == "turtle2"


def test_used_and_unknown_names_are_refused() -> None:
    """spawn() refuses a used name, and kill() refuses an unknown name."""
    world = World()
    with pytest.raises(NameTaken, match=r"A turtled named \[turtle1\] already exists"):
        world.spawn(1, 1, 0, "turtle1")
    with pytest.raises(UnknownTurtle, match=r"Tried to kill turtle \[nobody\], which does not exist"):
        world.kill("nobody")


def test_teleport_relative_turns_first() -> None:
    """teleport_relative() turns the turtle, and then moves the turtle forward."""
    world, turtle = driven()
    turtle.teleport_relative(world.canvas, 2.0, math.pi / 2)
    assert (turtle.x, turtle.y) == (pytest.approx(HOME), pytest.approx(HOME + 2))


def test_the_sensor_reads_what_the_pens_drew() -> None:
    """The sensor reads the colour of a line, or the background colour."""
    world, turtle = driven()
    turtle.pen = Pen(colour=(10, 20, 30), width=6)
    turtle.teleport(world.canvas, HOME + 2, HOME, 0.0)
    turtle.teleport(world.canvas, HOME + 1, HOME, 0.0)
    world.tick(0.0)
    assert turtle.colour == (10, 20, 30)
    turtle.pen = Pen(down=False)
    turtle.teleport(world.canvas, 2.0, 2.0, 0.0)
    world.tick(TICK)
    assert turtle.colour == BACKGROUND


def test_clear_keeps_turtles_and_erases_lines() -> None:
    """After clear(), the sensor reads the background colour, and the turtle has not moved."""
    world, turtle = driven()
    turtle.teleport(world.canvas, 2.0, 2.0, 0.0)
    world.clear((1, 2, 3))
    world.tick(0.0)
    assert (turtle.x, turtle.colour) == (2.0, (1, 2, 3))


@pytest.mark.parametrize("command", [(1e308, -1e308, 1e308), (-1e300, 1e-300, -1e300), (3e38, 3e38, 3e38)])
def test_huge_velocities_keep_the_world_valid(command: tuple[float, float, float]) -> None:
    """With every finite velocity, the turtle stays inside the world."""
    world, turtle = driven(*command)
    run(world, 5)
    assert 0.0 <= turtle.x <= WIDTH
    assert 0.0 <= turtle.y <= WIDTH
    assert -math.pi <= turtle.theta <= math.pi


def coloured(start: Point, end: Point, width: int) -> set[tuple[int, int]]:
    """Draw a line, and return its pixels in the top left area of 60 by 60 px."""
    canvas = Canvas(GROUND)
    canvas.line(start, end, LINE, width)
    return {(x, y) for x in range(60) for y in range(60) if canvas.colour_at((x, y)) == LINE}


def test_a_line_has_its_width() -> None:
    """A horizontal line with width 3 colours three rows of pixels."""
    pixels = coloured((10.0, 20.0), (30.0, 20.0), 3)
    assert {y for _, y in pixels} == {19, 20, 21}
    assert (min(x for x, _ in pixels), max(x for x, _ in pixels)) == (9, 31)


def test_width_0_draws_one_pixel() -> None:
    """A line with width 0 colours one row of pixels."""
    assert len({y for _, y in coloured((10.0, 20.0), (30.0, 20.0), 0)}) == 1


@pytest.mark.parametrize("end", [(50.0, 12.0), (12.0, 50.0), (50.0, 50.0), (33.0, 47.0)])
def test_a_slanted_line_has_no_gaps(end: Point) -> None:
    """In a thin line, each pixel touches another pixel of the line."""
    pixels = coloured((10.0, 10.0), end, 1)
    reached, todo = set(), [min(pixels)]
    while todo:
        x, y = todo.pop()
        if (x, y) in pixels - reached:
            reached.add((x, y))
            todo += [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
    assert reached == pixels


def test_a_line_without_length_is_a_square() -> None:
    """A line from a point to the same point is a square with the width of the pen."""
    assert len(coloured((20.5, 20.5), (20.5, 20.5), 4)) == 16


def test_a_line_may_leave_the_canvas() -> None:
    """A line is drawn up to the edge of the canvas."""
    canvas = Canvas(GROUND)
    canvas.line((-1000.0, 5.0), (1500.0, 5.0), LINE, 255)
    assert canvas.colour_at((-7.0, 5.0)) == canvas.colour_at((SIDE + 50.0, 5.0)) == LINE
    assert canvas.colour_at((250.0, 499.0)) == GROUND


def test_fill_colours_all_pixels() -> None:
    """After fill(), all pixels have the new colour."""
    canvas = Canvas(GROUND)
    canvas.line((0.0, 0.0), (499.0, 499.0), LINE, 9)
    canvas.fill((9, 9, 9))
    assert {canvas.colour_at((step, step)) for step in range(SIDE)} == {(9, 9, 9)}


def test_the_widest_line_fits_into_a_tick() -> None:
    """A tick takes 16 ms, and drawing the widest line takes less CPU time than a tick."""
    canvas = Canvas(GROUND)
    took = []
    for _ in range(5):
        started = time.process_time()
        canvas.line((0.0, 0.0), (499.0, 499.0), LINE, 255)
        took.append(time.process_time() - started)
    assert min(took) < 0.016
