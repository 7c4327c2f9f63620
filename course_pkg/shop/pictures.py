"""Compute a colour picture of the shop, and the frames of a small grey camera.

This module does not need ROS.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import cycle, islice
from typing import Protocol

Colour = tuple[int, int, int]
WALL: Colour = (236, 226, 208)
FLOOR: Colour = (178, 156, 130)
COUNTER: Colour = (120, 84, 56)
TOP: Colour = (160, 118, 82)
FACE: Colour = (226, 184, 150)
COATS: tuple[Colour, ...] = ((46, 98, 150), (168, 60, 56), (62, 122, 78), (122, 84, 146), (196, 140, 44))
MOST = 12  # A picture shows at most this number of customers.
HALF_BREADTH = 0.13  # Half the width of a customer is this fraction of the picture's height.

WIDTH, HEIGHT = 160, 120  # A frame has this size in pixels.
DARK = 96  # A pixel with a lower brightness is dark.
SHARE = 10  # If at least 1/SHARE of the pixels are dark, the frame shows a customer.
BRIGHT, DARK_COAT = 208, 40  # The minimum brightness of the wall, and of a coat.
SHADE = 12  # Within the wall or a coat, the brightness of pixels varies by less than this value.
# Half the width of a head, and of the shoulders, as fractions of the frame's height.
HEAD, SHOULDERS = 0.14, 0.2


def shop_picture(width: int, height: int, customers: int) -> bytes:
    """Return the picture in the encoding rgb8: rows of pixels, beginning at the top left.

    Each pixel has three bytes. The picture shows at most `MOST` customers.
    """
    return b"".join(
        _picture_row((row + 0.5) / height, width, height, min(customers, MOST)) for row in range(height)
    )


def _picture_row(y: float, width: int, height: int, customers: int) -> bytes:
    """Return the bytes of the row at `y`, which is 0 at the top and 1 at the bottom."""
    if y >= 0.72:
        return bytes(TOP if y < 0.76 else COUNTER) * width
    row = bytearray(bytes(WALL if y < 0.6 else FLOOR) * width)
    # Many customers are drawn narrower; there are then gaps between them.
    squeeze = min(height, 0.44 / HALF_BREADTH * width / (customers + 1))
    for number, coat in enumerate(islice(cycle(COATS), customers), 1):
        half, colour = _figure_at(y, coat)
        middle = width * number / (customers + 1)
        left, right = (round(middle + side * half * squeeze) for side in (-1, 1))
        row[3 * left : 3 * right] = bytes(colour) * (right - left)
    return bytes(row)


def _figure_at(y: float, coat: Colour) -> tuple[float, Colour]:
    """Return half the width of a customer in the row at height `y`, and the customer's colour there.

    The width is a fraction of the picture's height.
    """
    head = 0.08**2 - (y - 0.3) ** 2
    if head > 0:
        return float(head**0.5), FACE
    return min(max(y - 0.38, 0.0) * 3, HALF_BREADTH), coat


class Frame(Protocol):
    """The fields of a sensor_msgs/Image that this module uses."""

    encoding: str
    width: int
    height: int
    step: int
    data: bytes


@lru_cache(maxsize=16)  # The camera needs a frame ten times per second, so the frames are cached.
def frame_points(customers: int) -> bytes:
    """Return the pixels of a frame, row by row: a light wall, with a dark shape for each customer."""
    return b"".join(_frame_row(row, customers) for row in range(HEIGHT))


def sees_customer(frame: Frame) -> bool:
    """Return whether a frame shows a customer, because at least a tenth of its pixels are dark.

    Raises ValueError for an invalid frame. A valid frame has the encoding mono8 and at least one pixel. A row
    is not longer than `step`, and the data have `height * step` bytes.
    """
    if frame.encoding != "mono8":
        raise ValueError(f"the encoding is {frame.encoding!r}, and not mono8")
    if not frame.width or not frame.height or frame.step < frame.width:
        raise ValueError(f"{frame.width} by {frame.height} points do not fit into rows of {frame.step} bytes")
    if len(frame.data) != frame.height * frame.step:
        raise ValueError(
            f"the frame has {len(frame.data)} bytes, but it needs {frame.height} rows of {frame.step} bytes"
        )
    rows = (frame.data[start : start + frame.width] for start in range(0, len(frame.data), frame.step))
    dark = sum(point < DARK for row in rows for point in row)
    return bool(SHARE * dark >= frame.width * frame.height)


def _frame_row(row: int, customers: int) -> bytes:
    """Return the pixels of one row, with the shapes of all customers."""
    points = bytearray(BRIGHT + _shade(row, column) for column in range(WIDTH))
    for column in _figures(row / HEIGHT, customers):
        points[column] = DARK_COAT + _shade(row, column)
    return bytes(points)


def _figures(y: float, customers: int) -> set[int]:
    """Return the pixel columns that customers cover at `y`, which is 0 at the top and 1 at the bottom."""
    head = HEAD**2 - (y - 0.3) ** 2
    half = round(HEIGHT * head**0.5) if head > 0 else round(HEIGHT * SHOULDERS) if y >= 0.46 else -1
    middles = [WIDTH * number // (customers + 1) for number in range(1, customers + 1)]
    near = {middle + side for middle in middles for side in range(-half, half + 1)}
    return near & set(range(WIDTH))


def _shade(row: int, column: int) -> int:
    return (7 * row + 13 * column) % SHADE
