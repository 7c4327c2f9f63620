"""What a small grey camera sees of a counter, computed, and whether somebody is in it. No ROS."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

WIDTH, HEIGHT = 160, 120  # points
DARK = 96  # a point below this is dark
SHARE = 10  # one dark point in so many is a customer
WALL, COAT = 208, 40  # how bright each is, give or take SHADE
SHADE = 12
HEAD, SHOULDERS = 0.14, 0.2  # half the breadth of a figure, in heights of the frame


@lru_cache(maxsize=16)  # the same counter again and again, ten times a second
def frame_points(customers: int) -> bytes:
    """Return the points of a frame, row by row: a light wall, and so many dark figures before it."""
    return b"".join(_row(row, customers) for row in range(HEIGHT))


def sees_customer(frame: Any) -> bool:  # noqa: ANN401 -- a class that genpy generates
    """Return whether somebody is in a frame (sensor_msgs/Image): at least a tenth of its points are dark.

    Raises ValueError for a frame that is none: not mono8, without points, or of another length than its
    height and step say.
    """
    if frame.encoding != "mono8":
        raise ValueError(f"the encoding is {frame.encoding!r}, and not mono8")
    if not frame.width or not frame.height or frame.step < frame.width:
        raise ValueError(f"{frame.width} by {frame.height} points in rows of {frame.step} bytes are no frame")
    if len(frame.data) != frame.height * frame.step:
        raise ValueError(f"{len(frame.data)} bytes, and {frame.height} rows of {frame.step} bytes each")
    rows = (frame.data[start : start + frame.width] for start in range(0, len(frame.data), frame.step))
    dark = sum(point < DARK for row in rows for point in row)
    return bool(SHARE * dark >= frame.width * frame.height)


def _row(row: int, customers: int) -> bytes:
    """Return one row; the figures stand side by side, a head and a coat each."""
    points = bytearray(WALL + _shade(row, column) for column in range(WIDTH))
    for column in _figures(row / HEIGHT, customers):
        points[column] = COAT + _shade(row, column)
    return bytes(points)


def _figures(y: float, customers: int) -> set[int]:
    """Return the columns that are somebody's at `y`, 0 at the top and 1 at the bottom."""
    head = HEAD**2 - (y - 0.3) ** 2
    half = round(HEIGHT * head**0.5) if head > 0 else round(HEIGHT * SHOULDERS) if y >= 0.46 else -1
    middles = [WIDTH * place // (customers + 1) for place in range(1, customers + 1)]
    near = {middle + side for middle in middles for side in range(-half, half + 1)}
    return near & set(range(WIDTH))


def _shade(row: int, column: int) -> int:
    return (7 * row + 13 * column) % SHADE
