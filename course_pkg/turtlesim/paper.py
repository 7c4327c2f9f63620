"""What the pens drew: a picture of pixels, made by thick lines."""

from __future__ import annotations

import math

Colour = tuple[int, int, int]
Point = tuple[float, float]

SIDE = 500  # px
DEPTH = 3  # bytes a pixel: red, green, blue
MISSED = (1.0, 0.0)  # a row without anything in it


class Paper:
    """A square of 500 by 500 pixels, from the top left, y downwards; whole numbers are pixels' centres."""

    def __init__(self, background: Colour) -> None:
        self._pixels = bytearray()
        self.fill(background)

    def fill(self, colour: Colour) -> None:
        """Make the whole of it `colour`."""
        self._pixels[:] = bytes(colour) * (SIDE * SIDE)

    def colour_at(self, point: Point) -> Colour:
        """Return the colour of the pixel that is nearest to `point` (px); the edge's for a point outside."""
        column, row = (min(max(math.floor(each + 0.5), 0), SIDE - 1) for each in point)
        start = (row * SIDE + column) * DEPTH
        red, green, blue = self._pixels[start : start + DEPTH]
        return red, green, blue

    def line(self, start: Point, end: Point, colour: Colour, width: int) -> None:
        """Draw a straight line, `width` px wide, that goes on by half its width beyond either end."""
        half = max(width, 1) / 2
        reach = half * math.sqrt(2)
        top = max(math.floor(min(start[1], end[1]) - reach), 0)
        bottom = min(math.ceil(max(start[1], end[1]) + reach) + 1, SIDE)
        band = _Band(start, end, half)
        for row in range(top, bottom):
            left, right = band.across(row)
            first, last = max(math.ceil(left), 0), min(math.floor(right), SIDE - 1)
            if first <= last:
                begin = (row * SIDE + first) * DEPTH
                count = last - first + 1
                self._pixels[begin : begin + count * DEPTH] = bytes(colour) * count


class _Band:
    """A line with a width and square ends: the rectangle around it."""

    def __init__(self, start: Point, end: Point, half: float) -> None:
        along = (end[0] - start[0], end[1] - start[1])
        length = math.hypot(*along)
        ux, uy = (along[0] / length, along[1] / length) if length else (1.0, 0.0)
        # Between two pairs of parallel edges: each as a direction and the range that lies between them.
        self._pairs = ((ux, uy, -half, length + half), (-uy, ux, -half, half))
        self._start = start

    def across(self, y: float) -> tuple[float, float]:
        """Return where the row at `y` begins and ends inside the rectangle; the end first where it misses."""
        x, dy = self._start[0], y - self._start[1]
        left, right = -math.inf, math.inf
        for ux, uy, low, high in self._pairs:
            if abs(ux) < 1e-9:
                if not low <= dy * uy <= high:
                    return MISSED
                continue
            ends = sorted((x + (low - dy * uy) / ux, x + (high - dy * uy) / ux))
            left, right = max(left, ends[0]), min(right, ends[1])
        return left, right
