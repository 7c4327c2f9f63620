"""Tests of the rows of a turtle recording."""

from __future__ import annotations

import json

import pytest

from course_pkg.panels.turtles.pen import HOME, USUAL, Colour, Observation
from course_pkg.panels.turtles.recording import BACKGROUND, MOST, UP, TurtleRecording

RED: Colour = (255, 0, 0)
LOOK = 50  # the time between two consecutive observations in ms


def at(x: float, colour: Colour | None = BACKGROUND, speed: float = 1.0, y: float = 2.0) -> Observation:
    """Return the observation of a turtle that faces right."""
    return Observation(x, y, 0.0, speed, colour)


def filmed(*snapshots: Observation) -> TurtleRecording:
    """Return the recording of a turtle; consecutive observations are `LOOK` ms apart."""
    recording = TurtleRecording()
    for number, seen in enumerate(snapshots):
        recording.see(number * LOOK, "turtle1", seen)
    return recording


def test_a_turtle_that_rests_makes_one_row() -> None:
    """While a turtle does not move, no rows are added to the recording."""
    recording = filmed(*[at(3.0, speed=0.0)] * 1200)
    assert recording.rows == [(0, 0, 3000, 2000, 0, UP)]
    assert recording.length == 1199 * LOOK


def test_a_turtle_stands_still_in_the_replay_until_it_starts() -> None:
    """When a resting turtle starts to move, the recording gets a row for its last time at rest.

    Without this row, the replay would show a slow movement during the time at rest.
    """
    recording = filmed(*[at(3.0, speed=0.0)] * 10, at(3.1))
    assert [row[:3] for row in recording.rows] == [(0, 0, 3000), (9 * LOOK, 0, 3000), (10 * LOOK, 0, 3100)]


def test_the_usual_pen_until_more_is_known() -> None:
    """At the start, a turtle draws with the default pen colour."""
    recording = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, USUAL))
    assert recording.palette[recording.rows[-1][5]] == USUAL


def test_a_colour_that_is_read_twice_at_low_speed_is_the_pen_colour() -> None:
    """If the sensor of a slow turtle reads the same colour twice, this colour becomes the pen colour."""
    recording = filmed(at(3.0, speed=0.0), at(3.1, RED), at(3.2, RED), at(3.3, RED))
    assert [recording.palette[row[5]] for row in recording.rows[-2:]] == [RED, RED]


def test_a_crossed_line_does_not_change_the_pen() -> None:
    """If only a single pose has another colour, the pen colour does not change."""
    recording = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, RED), at(3.3, USUAL))
    assert {row[5] for row in recording.rows[1:]} == {recording.palette.index(USUAL)}


def test_a_slow_turtle_on_plain_paper_has_its_pen_up() -> None:
    """If the sensor of a slow turtle reads the background colour, the recording says that the pen is up."""
    recording = filmed(at(3.0, speed=0.0), at(3.05), at(3.1), at(3.15))
    assert [row[2] for row in recording.rows if isinstance(row[2], str)] == ["undrawn"]
    assert recording.rows[-1][5] == UP


def test_a_fast_turtle_on_plain_paper_may_still_draw() -> None:
    """If the sensor of a fast turtle reads the background colour, the pen can still be down."""
    fast = [at(3.0 + 0.25 * step, speed=5.0) for step in range(8)]
    recording = filmed(*fast)
    assert recording.rows[-1][5] != UP
    for number in range(8, 13):
        recording.see(number * LOOK, "turtle1", at(4.75, speed=0.0))
    assert any(row[2] == "undrawn" for row in recording.rows)


def test_clear_is_seen_by_a_turtle_on_its_line() -> None:
    """If the colour under a resting turtle changes to the background colour, the replay erases all lines."""
    resting = [at(3.1, USUAL, speed=0.0)] * 3
    recording = filmed(at(3.0, speed=0.0), at(3.1, USUAL), *resting, at(3.1, speed=0.0))
    assert recording.rows[-1][1:] == (UP, "cleared")


def test_reset_is_seen_by_the_first_turtle() -> None:
    """After a reset of the simulator, the replay erases the drawing."""
    home = Observation(HOME, HOME, 0.0, 0.0, BACKGROUND)
    recording = filmed(at(3.0, speed=0.0), at(3.1, USUAL), at(3.2, USUAL), home, home)
    assert (UP, "cleared") in [row[1:] for row in recording.rows]
    assert recording.rows[-1][5] == UP


def test_a_turtle_that_leaves_and_comes_back() -> None:
    """If a turtle disappears and appears again, no line connects the two positions."""
    recording = filmed(at(3.0))
    recording.miss(100, "turtle1")
    recording.see(200, "turtle1", at(9.0))
    assert [row[1:3] for row in recording.rows] == [(0, 3000), (0, "gone"), (0, 9000)]
    assert recording.names == ["turtle1"]


@pytest.mark.parametrize("turtles", [1, 5])
def test_a_recording_is_bounded(turtles: int) -> None:
    """The recording contains only the newest `MOST` rows."""
    recording = TurtleRecording()
    for number in range(3 * MOST):
        seen = at(1 + (number % 900) / 100)
        recording.see(number * LOOK, f"turtle{number % turtles}", seen)
    assert len(recording.rows) <= MOST
    assert recording.edition > 0
    assert recording.rows[-1][0] == (3 * MOST - 1) * LOOK
    assert [row[0] for row in recording.rows] == sorted(row[0] for row in recording.rows)
    assert len(json.dumps(recording.state())) < 250_000
