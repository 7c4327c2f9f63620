"""What the turtle panel makes of poses and colours: rows to draw, by pure models."""

from __future__ import annotations

import json

import pytest

from course_pkg.panels.turtles.ink import HOME, USUAL, Colour, Sight
from course_pkg.panels.turtles.tape import BACKGROUND, MOST, UP, Tape

RED: Colour = (255, 0, 0)
LOOK = 50  # ms


def at(x: float, colour: Colour | None = BACKGROUND, speed: float = 1.0, y: float = 2.0) -> Sight:
    """Return a sight of a turtle that heads to the right."""
    return Sight(x, y, 0.0, speed, colour)


def filmed(*sights: Sight) -> Tape:
    """Return the tape of one turtle, looked at every 50 ms."""
    tape = Tape()
    for number, sight in enumerate(sights):
        tape.see(number * LOOK, "turtle1", sight)
    return tape


def test_a_turtle_that_rests_makes_one_row() -> None:
    """A minute of standing still costs nothing."""
    tape = filmed(*[at(3.0, speed=0.0)] * 1200)
    assert tape.rows == [[0, 0, 3000, 2000, 0, UP]]
    assert tape.length == 1199 * LOOK


def test_a_start_after_a_rest_is_not_a_creep() -> None:
    """The last place before it moved has a row of its own, so that nothing slides through the rest."""
    tape = filmed(*[at(3.0, speed=0.0)] * 10, at(3.1))
    assert [row[:3] for row in tape.rows] == [[0, 0, 3000], [9 * LOOK, 0, 3000], [10 * LOOK, 0, 3100]]


def test_the_usual_pen_until_more_is_known() -> None:
    """A turtle that sets out draws in the pen that turtles begin with."""
    tape = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, USUAL))
    assert tape.palette[tape.rows[-1][5]] == USUAL


def test_a_colour_read_twice_while_it_is_slow_is_its_pens() -> None:
    """The sensor reads its own line: from then on the way is drawn in that colour."""
    tape = filmed(at(3.0, speed=0.0), at(3.1, RED), at(3.2, RED), at(3.3, RED))
    assert [tape.palette[row[5]] for row in tape.rows[-2:]] == [RED, RED]


def test_a_line_that_is_crossed_is_not_its_pen() -> None:
    """One look at another colour says nothing."""
    tape = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, RED), at(3.3, USUAL))
    assert {row[5] for row in tape.rows[1:]} == {tape.palette.index(USUAL)}


def test_a_slow_turtle_on_plain_paper_has_its_pen_up() -> None:
    """What had been taken for drawn since it was last sure is taken back."""
    tape = filmed(at(3.0, speed=0.0), at(3.05), at(3.1), at(3.15))
    assert [row[2] for row in tape.rows if isinstance(row[2], str)] == ["undrawn"]
    assert tape.rows[-1][5] == UP


def test_a_fast_turtle_on_plain_paper_may_draw_all_the_same() -> None:
    """It reads the paper ahead of its line; only at rest it is known."""
    fast = [at(3.0 + 0.25 * step, speed=5.0) for step in range(8)]
    tape = filmed(*fast)
    assert tape.rows[-1][5] != UP
    for number in range(8, 13):
        tape.see(number * LOOK, "turtle1", at(4.75, speed=0.0))
    assert any(row[2] == "undrawn" for row in tape.rows)


def test_clear_is_seen_by_a_turtle_on_its_line() -> None:
    """Its colour turns plain while it stands: the paper is new."""
    resting = [at(3.1, USUAL, speed=0.0)] * 3
    tape = filmed(at(3.0, speed=0.0), at(3.1, USUAL), *resting, at(3.1, speed=0.0))
    assert tape.rows[-1][1:] == [UP, "wiped"]


def test_reset_is_seen_by_the_first_turtle() -> None:
    """It is at home at once, facing right, on plain paper: all is new."""
    home = Sight(HOME, HOME, 0.0, 0.0, BACKGROUND)
    tape = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, USUAL), home, home)
    assert [UP, "wiped"] in [row[1:] for row in tape.rows]
    assert tape.rows[-1][5] == UP


def test_a_turtle_that_leaves_and_comes_back() -> None:
    """Its name keeps its number, and the two stays are not joined by a line."""
    tape = filmed(at(3.0))
    tape.miss(100, "turtle1")
    tape.see(200, "turtle1", at(9.0))
    assert [row[1:3] for row in tape.rows] == [[0, 3000], [0, "gone"], [0, 9000]]
    assert tape.names == ["turtle1"]


@pytest.mark.parametrize("turtles", [1, 5])
def test_a_tape_is_bounded(turtles: int) -> None:
    """However long it runs, at most MOST rows are kept, the newest among them, and it is small when saved."""
    tape = Tape()
    for number in range(3 * MOST):
        sight = at(1 + (number % 900) / 100)
        tape.see(number * LOOK, f"turtle{number % turtles}", sight)
    assert len(tape.rows) <= MOST
    assert tape.edition > 0
    assert tape.rows[-1][0] == (3 * MOST - 1) * LOOK
    assert [row[0] for row in tape.rows] == sorted(row[0] for row in tape.rows)
    assert len(json.dumps(tape.state())) < 250_000
