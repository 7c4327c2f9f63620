"""Fewer points that draw the same picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

Point = tuple[float, float]

COLUMNS = 960  # a panel is never wider, in px
ROWS = 480  # and a plot never higher
MANY = 2 * COLUMNS  # points below which nothing is gained


def thinned(points: Sequence[Point], kind: str, log: bool = False) -> list[Point]:
    """Return the points to draw, in their order: all of them, or those that make a difference on the page.

    A line that runs from left to right keeps in each pixel column its first, smallest, largest and last
    point: the strokes drawn are then the same (Jugel et al., M4, VLDB 2014). Dots keep one for each pixel,
    and a line that turns back what differs from the point before by a pixel. With `log` the second
    numbers are all above 0.
    """
    if len(points) <= MANY:
        return list(points)
    if kind == "line" and all(one[0] <= other[0] for one, other in pairwise(points)):
        return _by_column(points)
    return _by_pixel(points, kind, log)


def _by_column(points: Sequence[Point]) -> list[Point]:
    columns: dict[int, list[int]] = {}
    for index, number in enumerate(_cells([point[0] for point in points], COLUMNS)):
        columns.setdefault(number, []).append(index)
    kept: list[Point] = []
    for column in columns.values():
        smallest = min(column, key=lambda index: points[index][1])
        largest = max(column, key=lambda index: points[index][1])
        kept += [points[index] for index in sorted({column[0], smallest, largest, column[-1]})]
    return kept


def _by_pixel(points: Sequence[Point], kind: str, log: bool) -> list[Point]:
    heights = [math.log(point[1]) if log else point[1] for point in points]
    pixels = zip(_cells([point[0] for point in points], COLUMNS), _cells(heights, ROWS), strict=True)
    kept: list[Point] = []
    taken: set[tuple[int, int]] = set()
    for point, pixel in zip(points, pixels, strict=True):
        if pixel not in taken:
            if kind == "line":
                taken.clear()
            taken.add(pixel)
            kept.append(point)
    return kept


def _cells(values: Sequence[float], count: int) -> list[int]:
    """Return for each value in which of `count` equal parts of the whole range it lies."""
    low, high = min(values), max(values)
    span = high / count - low / count  # not (high - low) / count: that may be infinite
    return [min(count - 1, int(value / span - low / span)) if span else 0 for value in values]
