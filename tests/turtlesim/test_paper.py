"""The picture that the pens draw."""

from __future__ import annotations

import time

import pytest

from course_pkg.turtlesim.paper import SIDE, Paper, Point

GROUND, INK = (69, 86, 255), (1, 2, 3)


def inked(start: Point, end: Point, width: int) -> set[tuple[int, int]]:
    """Return the pixels that a line colours near its ends and between."""
    paper = Paper(GROUND)
    paper.line(start, end, INK, width)
    return {(x, y) for x in range(60) for y in range(60) if paper.colour_at((x, y)) == INK}


def test_width() -> None:
    """A level line of width 3 colours three rows, and half its width beyond each end."""
    pixels = inked((10.0, 20.0), (30.0, 20.0), 3)
    assert {y for _, y in pixels} == {19, 20, 21}
    assert (min(x for x, _ in pixels), max(x for x, _ in pixels)) == (9, 31)


def test_width_0_draws_one_pixel() -> None:
    """Width 0 is as thin as can be, and not nothing."""
    assert len({y for _, y in inked((10.0, 20.0), (30.0, 20.0), 0)}) == 1


@pytest.mark.parametrize("end", [(50.0, 12.0), (12.0, 50.0), (50.0, 50.0), (33.0, 47.0)])
def test_a_slanted_line_has_no_gaps(end: Point) -> None:
    """Each pixel of a thin line touches the next."""
    pixels = inked((10.0, 10.0), end, 1)
    reached, todo = set(), [min(pixels)]
    while todo:
        x, y = todo.pop()
        if (x, y) in pixels - reached:
            reached.add((x, y))
            todo += [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
    assert reached == pixels


def test_a_point_is_a_square() -> None:
    """A line without length is as wide as the pen."""
    assert len(inked((20.5, 20.5), (20.5, 20.5), 4)) == 16


def test_outside_is_cut_off() -> None:
    """A line may leave the paper on any side, and reading beyond the edge reads the edge."""
    paper = Paper(GROUND)
    paper.line((-1000.0, 5.0), (1500.0, 5.0), INK, 255)
    assert paper.colour_at((-7.0, 5.0)) == paper.colour_at((SIDE + 50.0, 5.0)) == INK
    assert paper.colour_at((250.0, 499.0)) == GROUND


def test_a_fill_covers_all() -> None:
    """New paper has one colour."""
    paper = Paper(GROUND)
    paper.line((0.0, 0.0), (499.0, 499.0), INK, 9)
    paper.fill((9, 9, 9))
    assert {paper.colour_at((step, step)) for step in range(SIDE)} == {(9, 9, 9)}


def test_the_widest_line_fits_into_a_tick() -> None:
    """Across the paper with the widest pen: far below the 16 ms of a tick in processor time, best of five."""
    paper = Paper(GROUND)
    took = []
    for _ in range(5):
        started = time.process_time()
        paper.line((0.0, 0.0), (499.0, 499.0), INK, 255)
        took.append(time.process_time() - started)
    assert min(took) < 0.016
