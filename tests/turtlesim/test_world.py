"""The world of turtles by itself: no ROS, and a clock of the tests' own."""

from __future__ import annotations

import math
import struct

import pytest

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
    wrapped,
)


def run(world: World, ticks: int, start: float = 0.0) -> list[str]:
    """Let time pass; return all warnings."""
    return [words for tick in range(ticks) for words in world.tick(start + tick * TICK)]


def driven(forward: float = 0.0, sideways: float = 0.0, turn: float = 0.0) -> tuple[World, Turtle]:
    """Return a world whose turtle has just been told a velocity."""
    world = World()
    turtle = world.turtles["turtle1"]
    turtle.velocity = Velocity(forward, sideways, turn, since=0.0)
    return world, turtle


def float32(value: float) -> float:
    """Return what remains of a number on the wire."""
    (kept,) = struct.unpack("<f", struct.pack("<f", value))
    return float(kept)


def test_the_first_turtle_stands_in_the_middle() -> None:
    """turtle1 is at 5.544444561004639 in both, as a float32, and the world is 11.088889 wide."""
    turtle = World().turtles["turtle1"]
    assert (float32(turtle.x), float32(turtle.y)) == (5.544444561004639, 5.544444561004639)
    assert (turtle.theta, round(WIDTH, 6)) == (0.0, 11.088889)


def test_one_order_holds_for_a_second() -> None:
    """An x of 1 moves the turtle 0.016 m a tick, 1.008 m in all, and then it stands."""
    world, turtle = driven(forward=1.0)
    world.tick(0.0)
    assert turtle.x - HOME == pytest.approx(0.016)
    run(world, 200, start=TICK)
    assert turtle.x - HOME == pytest.approx(1.008)
    assert turtle.speed == 0.0


def test_an_arc() -> None:
    """(2, 1.8) turns 1.8144 in its second, and ends 2.5 cm off the ideal arc: it turns, then moves."""
    world, turtle = driven(forward=2.0, turn=1.8)
    run(world, 100)
    assert turtle.theta == pytest.approx(1.8144)
    radius = 2.0 / 1.8
    ideal = HOME + radius * math.sin(1.8144), HOME + radius * (1 - math.cos(1.8144))
    assert math.dist(ideal, (turtle.x, turtle.y)) == pytest.approx(0.0155, abs=0.012)


def test_sideways() -> None:
    """linear.y moves to the left of where it looks, and the reported velocity is a magnitude."""
    world, turtle = driven(forward=3.0, sideways=-4.0)
    world.tick(0.0)
    assert (turtle.x - HOME, turtle.y - HOME) == (pytest.approx(0.048), pytest.approx(-0.064))
    assert turtle.speed == 5.0


def test_the_wall() -> None:
    """It is clamped, warned of at each tick with the place it would be at, and still tells its speed."""
    world, turtle = driven(forward=1000.0)
    warnings = run(world, 3)
    assert turtle.x == WIDTH
    assert turtle.speed == 1000.0
    assert warnings[0] == f"Oh no! I hit the wall! (Clamping from [x={HOME + 16:f}, y={HOME:f}])"
    assert len(warnings) == 3


@pytest.mark.parametrize(
    ("angle", "read"), [(math.pi, -3.141593), (-math.pi, 3.141593), (7.0, 0.716815), (-4.0, 2.283185), (0, 0)]
)
def test_theta_is_wrapped(angle: float, read: float) -> None:
    """What comes as a float32 of +π reads -3.141593, and the other way round."""
    assert round(wrapped(float32(angle)), 6) == read


def test_spawn_outside_is_clamped() -> None:
    """A turtle that is made far off stands at the wall a tick later."""
    world = World()
    turtle = world.spawn(-3.0, 99.0, 0.0, "far")
    assert len(world.tick(0.0)) == 1
    assert (turtle.x, turtle.y) == (0.0, WIDTH)


def test_names_by_itself() -> None:
    """turtle2, turtle3, …: names in use are skipped, those of the killed are not used again."""
    world = World()
    world.spawn(1, 1, 0, "turtle3")
    assert [world.spawn(1, 1, 0).name for _ in range(2)] == ["turtle2", "turtle4"]
    world.kill("turtle4")
    assert world.spawn(1, 1, 0).name == "turtle5"
    world.reset(BACKGROUND)
    assert sorted(world.turtles) == ["turtle1"]
    assert world.spawn(1, 1, 0).name == "turtle2"


def test_a_name_is_given_once() -> None:
    """A second turtle of a name is refused in the words of the real one, and so is killing nobody."""
    world = World()
    with pytest.raises(NameTaken, match=r"A turtled named \[turtle1\] already exists"):
        world.spawn(1, 1, 0, "turtle1")
    with pytest.raises(UnknownTurtle, match=r"Tried to kill turtle \[nobody\], which does not exist"):
        world.kill("nobody")


def test_leap_turns_first() -> None:
    """teleport_relative turns, then moves."""
    world, turtle = driven()
    turtle.leap(world.paper, 2.0, math.pi / 2)
    assert (turtle.x, turtle.y) == (pytest.approx(HOME), pytest.approx(HOME + 2))


def test_the_sensor_reads_what_the_pens_drew() -> None:
    """Over plain paper it reads the background, on a line its colour, with the pen up nothing new."""
    world, turtle = driven()
    turtle.pen = Pen(colour=(10, 20, 30), width=6)
    turtle.teleport(world.paper, HOME + 2, HOME, 0.0)
    turtle.teleport(world.paper, HOME + 1, HOME, 0.0)
    world.tick(0.0)
    assert turtle.colour == (10, 20, 30)
    turtle.pen = Pen(down=False)
    turtle.teleport(world.paper, 2.0, 2.0, 0.0)
    world.tick(TICK)
    assert turtle.colour == BACKGROUND


def test_clear_keeps_turtles_and_takes_new_paper() -> None:
    """After clear a line is gone, and the turtle stands where it stood."""
    world, turtle = driven()
    turtle.teleport(world.paper, 2.0, 2.0, 0.0)
    world.clear((1, 2, 3))
    world.tick(0.0)
    assert (turtle.x, turtle.colour) == (2.0, (1, 2, 3))


@pytest.mark.parametrize("order", [(1e308, -1e308, 1e308), (-1e300, 1e-300, -1e300), (3e38, 3e38, 3e38)])
def test_huge_orders_leave_the_world_sane(order: tuple[float, float, float]) -> None:
    """A turtle may be told to go at any finite speed: it stays inside, at a finite angle."""
    world, turtle = driven(*order)
    run(world, 5)
    assert 0.0 <= turtle.x <= WIDTH
    assert 0.0 <= turtle.y <= WIDTH
    assert -math.pi <= turtle.theta <= math.pi
