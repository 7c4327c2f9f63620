"""Tests of the programs draw_square and turtle_teleop_key."""

from __future__ import annotations

import math
import os
import pty
import subprocess

import pytest

from course_pkg.ros import NodeProcess
from course_pkg.turtlesim.draw_square import SIDE, Walker
from course_pkg.turtlesim.turtle_teleop_key import commands
from course_pkg.turtlesim.world import TICK, Velocity, World
from tests.kernel import Kernel
from tests.support import eventually


def test_a_square_closes() -> None:
    """After draw_square, the turtle is less than 0.1 m from its start."""
    world = World()
    turtle = world.turtles["turtle1"]
    start, corners, now = (turtle.x, turtle.y), 0, 0.0
    walker = Walker(turtle.x, turtle.y, turtle.theta)
    places = []
    while corners < 4 and now < 120:
        speed, turn = walker.steer(turtle.x, turtle.y, turtle.theta)
        if not (speed or turn):
            corners += walker.turning
            places.append((turtle.x, turtle.y))
            walker = walker.after(turtle.x, turtle.y)
        turtle.velocity = Velocity(speed, 0.0, turn, now)
        world.tick(now)
        now += TICK
    assert math.dist(start, (turtle.x, turtle.y)) < 0.1
    assert math.dist(start, places[0]) == pytest.approx(SIDE, abs=0.02)
    assert math.dist(start, places[2]) == pytest.approx(SIDE * math.sqrt(2), abs=0.1)


def test_draw_square_drives_the_turtle(simulator: NodeProcess, kernel: Kernel) -> None:
    """The turtle moves from the middle along the first side of the square."""
    kernel.run(
        "from course_pkg import join\nfrom turtlesim.msg import Pose\n"
        "node = join('watcher'); heard = node.subscribe('/turtle1/pose', Pose)"
    )
    with NodeProcess(["rosrun", "turtlesim", "draw_square"]) as walking:
        eventually(lambda: "Turning the corner" in walking.output(), timeout=20)
    assert kernel.run("result = heard.messages[-1].x") == pytest.approx(5.544 + SIDE, abs=0.1)


@pytest.mark.parametrize("chunks", [[b"\x1b[A\x1b[Dq"], [b"\x1b[", b"A", b"x\x1b", b"[D", b"q"]])
def test_arrow_keys_whole_or_in_pieces(chunks: list[bytes]) -> None:
    """The program recognises an arrow key even if the bytes of the key arrive separately."""
    reader, writer = os.pipe()
    found = []
    keys = commands(reader)
    for chunk in chunks:
        os.write(writer, chunk)
    os.close(writer)
    found = list(keys)
    os.close(reader)
    assert found == [(1, 0), (0, 1)]


def test_the_keyboard_drives(simulator: NodeProcess, kernel: Kernel) -> None:
    """An arrow key publishes a velocity, and q ends the node and restores the terminal's settings."""
    kernel.run(
        "from course_pkg import join\nfrom geometry_msgs.msg import Twist\n"
        "node = join('watcher'); heard = node.subscribe('/turtle1/cmd_vel', Twist)"
    )
    master, terminal = pty.openpty()
    before = subprocess.run(["stty", "-g"], stdin=terminal, capture_output=True, check=True).stdout
    with subprocess.Popen(
        ["rosrun", "turtlesim", "turtle_teleop_key"], stdin=terminal, stdout=subprocess.PIPE, text=True
    ) as program:
        assert program.stdout is not None
        assert program.stdout.readline().startswith("Drive turtle1")

        def pressed() -> int:
            os.write(master, b"\x1b[A")
            return int(kernel.run("result = heard.count"))

        eventually(pressed, interval=0.1)
        os.write(master, b"q")
        assert program.wait(10) == 0
    assert kernel.run("result = heard.messages[0].linear.x") == 2.0
    assert subprocess.run(["stty", "-g"], stdin=terminal, capture_output=True, check=True).stdout == before
    os.close(master)
    os.close(terminal)


def test_turtle_teleop_key_needs_a_terminal() -> None:
    """If the input is a pipe, the program prints an error message, and the exit status is 1."""
    done = subprocess.run(
        ["rosrun", "turtlesim", "turtle_teleop_key"], input="", capture_output=True, text=True, timeout=30
    )
    assert done.returncode == 1
    assert "run it in a terminal" in done.stderr
