"""Tests of the pictures of the shop."""

from __future__ import annotations

from itertools import groupby
from types import SimpleNamespace

import pytest

from course_pkg.shop.pictures import (
    COATS,
    FACE,
    HEIGHT,
    MOST,
    WIDTH,
    frame_points,
    sees_customer,
    shop_picture,
)


def figures(width: int, height: int, customers: int, y: float) -> int:
    """Count the coloured segments in a pixel row of a picture of the shop; `y` is 0 (top) to 1 (bottom)."""
    data = shop_picture(width, height, customers)
    start = 3 * width * int(y * height)
    row = [tuple(data[place : place + 3]) for place in range(start, start + 3 * width, 3)]
    return sum(colour in (*COATS, FACE) for colour, _ in groupby(row))


@pytest.mark.parametrize("customers", range(MOST + 1))
@pytest.mark.parametrize("y", [0.3, 0.55])
def test_each_customer_is_seen(customers: int, y: float) -> None:
    """A row of the picture has one coloured segment for each customer."""
    assert figures(320, 240, customers, y) == customers


@pytest.mark.parametrize("size", [(16, 16), (17, 400), (1280, 16), (320, 240)])
@pytest.mark.parametrize("customers", [0, 1, 5, 1000])
def test_a_picture_has_all_its_points_at_any_size(size: tuple[int, int], customers: int) -> None:
    """A picture of any size has three bytes for each pixel."""
    width, height = size
    assert len(shop_picture(width, height, customers)) == 3 * width * height


def test_the_same_shop_is_the_same_picture() -> None:
    """If two calls of shop_picture() have equal arguments, the pictures are equal."""
    assert shop_picture(64, 48, 3) == shop_picture(64, 48, 3)
    assert shop_picture(64, 48, 3) != shop_picture(64, 48, 2)


def frame(
    data: bytes, width: int = WIDTH, height: int = HEIGHT, *, step: int = 0, encoding: str = "mono8"
) -> SimpleNamespace:
    """Return the fields of a sensor_msgs/Image. If `step` is not given, the rows have no padding."""
    return SimpleNamespace(data=data, width=width, height=height, step=step or width, encoding=encoding)


@pytest.mark.parametrize("customers", [0, 1, 2, 3, 12])
def test_the_customers_in_a_frame_are_seen(customers: int) -> None:
    """`sees_customer` returns true only for a picture with customers."""
    points = frame_points(customers)
    assert len(points) == WIDTH * HEIGHT
    assert sees_customer(frame(points)) is (customers > 0)


@pytest.mark.parametrize(("dark", "seen"), [(9, False), (10, True), (11, True)])
def test_a_tenth_of_dark_points_is_enough(dark: int, seen: bool) -> None:
    """A picture shows a customer if at least a tenth of its pixels have a brightness below 96."""
    assert sees_customer(frame(bytes([95] * dark + [96] * (100 - dark)), 10, 10)) is seen


def test_the_padding_of_a_row_is_ignored() -> None:
    """If `step` is larger than the width, the function ignores the additional bytes of a row."""
    light, dark = bytes([200] * 10 + [0] * 6), bytes([0] * 10 + [255] * 90)
    assert not sees_customer(frame(light * 10, 10, 10, step=16))
    assert sees_customer(frame(dark, 10, 1, step=100))


@pytest.mark.parametrize(
    "broken",
    [
        frame(bytes(99), 10, 10),
        frame(bytes(101), 10, 10),
        frame(bytes(300), 10, 10, step=30, encoding="rgb8"),
        frame(b"", 0, 0),
        frame(b"", 10, 0),
        frame(bytes(90), 10, 10, step=9),
    ],
)
def test_a_malformed_frame_is_refused(broken: SimpleNamespace) -> None:
    """A malformed picture raises ValueError."""
    with pytest.raises(ValueError, match=r"\w"):
        sees_customer(broken)
