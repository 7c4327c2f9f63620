"""A picture of the shop, computed: a wall, a counter, and the customers who stand before it. No ROS."""

from __future__ import annotations

from itertools import cycle, islice

Colour = tuple[int, int, int]
WALL: Colour = (236, 226, 208)
FLOOR: Colour = (178, 156, 130)
COUNTER: Colour = (120, 84, 56)
TOP: Colour = (160, 118, 82)
HEAD: Colour = (226, 184, 150)
COATS: tuple[Colour, ...] = ((46, 98, 150), (168, 60, 56), (62, 122, 78), (122, 84, 146), (196, 140, 44))
MOST = 12  # customers who can be told apart
BREADTH = 0.13  # half that of a customer, in heights of the picture


def shop_picture(width: int, height: int, customers: int) -> bytes:
    """Return the picture as rgb8: `height` rows of `width` points of three bytes, from the top left.

    Beyond MOST customers no further ones are drawn.
    """
    return b"".join(_row((row + 0.5) / height, width, height, min(customers, MOST)) for row in range(height))


def _row(y: float, width: int, height: int, customers: int) -> bytes:
    """Return the row at `y`, 0 at the top and 1 at the bottom."""
    if y >= 0.72:
        return bytes(TOP if y < 0.76 else COUNTER) * width
    row = bytearray(bytes(WALL if y < 0.6 else FLOOR) * width)
    squeeze = min(height, 0.44 / BREADTH * width / (customers + 1))  # so that neighbours leave a gap
    for place, coat in enumerate(islice(cycle(COATS), customers), 1):
        half, colour = _figure(y, coat)
        middle = width * place / (customers + 1)
        left, right = (round(middle + side * half * squeeze) for side in (-1, 1))
        row[3 * left : 3 * right] = bytes(colour) * (right - left)
    return bytes(row)


def _figure(y: float, coat: Colour) -> tuple[float, Colour]:
    """Return half the breadth of a customer at `y`, in heights of the picture, and the colour there."""
    head = 0.08**2 - (y - 0.3) ** 2
    if head > 0:
        return float(head**0.5), HEAD
    return min(max(y - 0.38, 0.0) * 3, BREADTH), coat
