"""The node `teleop_turtle`: drives turtle1 with the arrow keys of a terminal."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from collections.abc import Iterator
from contextlib import contextmanager

import rospy
from geometry_msgs.msg import Twist

from course_pkg.ros import prepare_node

HELP = """\
Drive turtle1 with the arrow keys of this terminal.
  up, down     forwards, backwards
  left, right  turn
  q            quit
"""
STEP = 2.0  # This is the default of ~scale_linear in m/s and of ~scale_angular in rad/s.
POLL = 0.2  # Without a key press, the program calls rospy.is_shutdown() again after this time in s.
# The keys of this dict are the last letters of the arrow keys' escape codes.
KEYS = {"A": (1, 0), "B": (-1, 0), "D": (0, 1), "C": (0, -1)}


def main() -> None:
    """Read keys until the user types q or Ctrl-C, or until the input or the node ends."""
    if not sys.stdin.isatty():
        sys.exit("turtle_teleop_key reads keys, so run it in a terminal: rosrun turtlesim turtle_teleop_key")
    rospy.init_node("teleop_turtle")
    prepare_node()
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1)
    scales = rospy.get_param("~scale_linear", STEP), rospy.get_param("~scale_angular", STEP)
    sys.stdout.write(HELP)
    with _single_keys(sys.stdin.fileno()):
        for forward, turn in commands(sys.stdin.fileno()):
            command = Twist()
            command.linear.x, command.angular.z = forward * scales[0], turn * scales[1]
            publisher.publish(command)


def commands(file: int) -> Iterator[tuple[int, int]]:
    """Yield (forward, turn) for each arrow key; each number is -1, 0 or 1."""
    typed = ""
    while not rospy.is_shutdown():
        if not select.select([file], [], [], POLL)[0]:
            continue
        read = os.read(file, 64).decode(errors="replace")
        keys, quits, _ = (typed + read).partition("q")
        *complete, typed = keys.split("\x1b")
        for code in (*complete, typed):
            yield from _command(code)
        if quits or not read:
            return
        typed = f"\x1b{typed}" if "\x1b" in keys and len(typed) < 2 else ""


def _command(code: str) -> list[tuple[int, int]]:
    return [KEYS[code[1]]] if len(code) >= 2 and code[0] in "[O" and code[1] in KEYS else []


@contextmanager
def _single_keys(terminal: int) -> Iterator[None]:
    """Make the terminal send each key immediately and without echo.

    Restore the terminal's settings after the `with` block.
    """
    before = termios.tcgetattr(terminal)
    try:
        tty.setcbreak(terminal)
        yield
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, before)
