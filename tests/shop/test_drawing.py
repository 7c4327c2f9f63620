"""The picture of the shop shows as many customers as are there, at any size."""

from __future__ import annotations

from itertools import groupby

import pytest

from course_pkg.shop.drawing import COATS, HEAD, MOST, shop_picture


def figures(width: int, height: int, customers: int, y: float) -> int:
    """Count the patches of another colour in one row of a picture."""
    data = shop_picture(width, height, customers)
    start = 3 * width * int(y * height)
    row = [tuple(data[place : place + 3]) for place in range(start, start + 3 * width, 3)]
    return sum(colour in (*COATS, HEAD) for colour, _ in groupby(row))


@pytest.mark.parametrize("customers", range(MOST + 1))
@pytest.mark.parametrize("y", [0.3, 0.55])
def test_each_customer_is_seen(customers: int, y: float) -> None:
    """Heads and coats can be counted: neighbours leave a gap."""
    assert figures(320, 240, customers, y) == customers


@pytest.mark.parametrize("size", [(16, 16), (17, 400), (1280, 16), (320, 240)])
@pytest.mark.parametrize("customers", [0, 1, 5, 1000])
def test_any_size_has_all_its_points(size: tuple[int, int], customers: int) -> None:
    """Three bytes for each point, whatever the shape of the picture and however many customers."""
    width, height = size
    assert len(shop_picture(width, height, customers)) == 3 * width * height


def test_the_same_shop_is_the_same_picture() -> None:
    """A picture depends on nothing but what is asked, so that it can be stored and compared."""
    assert shop_picture(64, 48, 3) == shop_picture(64, 48, 3)
    assert shop_picture(64, 48, 3) != shop_picture(64, 48, 2)
