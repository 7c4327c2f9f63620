"""The canvas on which the turtles' pens draw: a square of pixels."""

from __future__ import annotations

import math

Colour = tuple[int, int, int]
Point = tuple[float, float]

SIDE = 500  # The canvas has this width and height in px.
DEPTH = 3  # A pixel has three bytes: red, green, blue.
EMPTY = (1.0, 0.0)  # The range is empty if a row does not touch the line.


class Canvas:
    """A canvas of 500 by 500 pixels. The origin is at the top left, and y points down.

    A point with integer coordinates is the centre of a pixel.
    """

    def __init__(self, background: Colour) -> None:
        self._pixels = bytearray()
        self.fill(background)

    def fill(self, colour: Colour) -> None:
        """Give all pixels the colour `colour`."""
        self._pixels[:] = bytes(colour) * (SIDE * SIDE)

    def colour_at(self, point: Point) -> Colour:
        """Return the colour of the pixel nearest to the point (px), which may be outside the canvas."""
        column, row = (min(max(math.floor(each + 0.5), 0), SIDE - 1) for each in point)
        start = (row * SIDE + column) * DEPTH
        red, green, blue = self._pixels[start : start + DEPTH]
        return red, green, blue

    def line(self, start: Point, end: Point, colour: Colour, width: int) -> None:
        """Draw a straight line with this width in px; each end is extended by half the width."""
        half = max(width, 1) / 2
        reach = half * math.sqrt(2)
        top = max(math.floor(min(start[1], end[1]) - reach), 0)
        bottom = min(math.ceil(max(start[1], end[1]) + reach) + 1, SIDE)
        rectangle = _Rectangle(start, end, half)
        for row in range(top, bottom):
            left, right = rectangle.across(row)
            first, last = max(math.ceil(left), 0), min(math.floor(right), SIDE - 1)
            if first <= last:
                begin = (row * SIDE + first) * DEPTH
                count = last - first + 1
                self._pixels[begin : begin + count * DEPTH] = bytes(colour) * count


class _Rectangle:
    """The rectangle of a wide line with square ends."""

    def __init__(self, start: Point, end: Point, half: float) -> None:
        along = (end[0] - start[0], end[1] - start[1])
        length = math.hypot(*along)
        ux, uy = (along[0] / length, along[1] / length) if length else (1.0, 0.0)
        # A rectangle has two pairs of parallel edges. Each entry describes one pair. An entry is (ux, uy,
        # low, high). The unit vector (ux, uy) is at a right angle to the two edges; `low` and `high` are
        # their positions along this vector.
        self._pairs = ((ux, uy, -half, length + half), (-uy, ux, -half, half))
        self._start = start

    def across(self, y: float) -> tuple[float, float]:
        """Return the range of x in which the row at `y` is inside the rectangle, or EMPTY."""
        x, dy = self._start[0], y - self._start[1]
        left, right = -math.inf, math.inf
        for ux, uy, low, high in self._pairs:
            if abs(ux) < 1e-9:
                if not low <= dy * uy <= high:
                    return EMPTY
                continue
            ends = sorted((x + (low - dy * uy) / ux, x + (high - dy * uy) / ux))
            left, right = max(left, ends[0]), min(right, ends[1])
        return left, right
