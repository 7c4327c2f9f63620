"""What a small grey camera sees of a counter, computed, and whether somebody is in it. No ROS."""

from __future__ import annotations

from typing import Any

WIDTH, HEIGHT = 32, 24  # points
DARK = 96  # a point below this is dark
SHARE = 10  # one dark point in so many is a customer
WALL, COAT = 208, 40  # how bright each is, give or take SHADE
SHADE = 12


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
    return SHARE * dark >= frame.width * frame.height


def _row(row: int, customers: int) -> bytes:
    """Return one row; the figures stand side by side in the lower three quarters."""
    points = bytearray(WALL + _shade(row, column) for column in range(WIDTH))
    if row >= HEIGHT // 4:
        for column in _figures(customers):
            points[column] = COAT + _shade(row, column)
    return bytes(points)


def _figures(customers: int) -> list[int]:
    """Return the columns in which somebody stands."""
    half = WIDTH // 10
    middles = [WIDTH * place // (customers + 1) for place in range(1, customers + 1)]
    return [middle + side for middle in middles for side in range(-half, half + 1) if middle + side < WIDTH]


def _shade(row: int, column: int) -> int:
    return (7 * row + 13 * column) % SHADE
