"""The responses of /getGeometry, a service that measures boxes."""

from __future__ import annotations

import math
from collections.abc import Callable

from course_pkg.checking.assertions import Hints
from course_pkg.checking.context import CheckContext
from course_pkg.checking.plain_values import Message

# The relative error of a float32 is less than this number.
FLOAT32 = 1e-7
# If a number was rounded to two decimals, its relative error is usually larger than `NEAR`.
NEAR = 1e-5


def random_boxes(context: CheckContext) -> list[list[float]]:
    """Return the length, the width and the height of random boxes.

    The first box has the size of a table. The other boxes are very small boxes, large boxes, boxes with whole
    numbers, and a cube, in a random order. A server that is correct only for boxes of one size therefore
    fails.
    """
    sizes = [(1.1, 9.0, 2)] * context.random.integer(2, 4)
    sizes += [(0.02, 0.4, 3), (12.0, 900.0, 2), (1.0, 99.0, 0)]
    boxes = [context.random.numbers(3, low, high, digits=digits) for low, high, digits in sizes]
    boxes.append([context.random.number(0.5, 90.0)] * 3)
    return [boxes[0], *context.random.shuffled(boxes[1:])]


def near_to(right: float) -> float:
    """Return the tolerance for a comparison with `right`.

    `near` is also an absolute tolerance, and for a very small box, `NEAR` would accept a rounded number.
    """
    return NEAR * min(1.0, abs(right))


def is_rounded(right: float) -> Callable[[float], bool]:
    """Return a condition for a number with at most six decimals that is nearly equal to `right`."""
    return lambda actual: any(
        math.isclose(actual, round(actual, digits), rel_tol=FLOAT32)
        and abs(actual - right) < 0.51 * 10.0**-digits
        for digits in range(7)
    )


def expect_geometry(
    context: CheckContext,
    response: Message,
    base: float,
    height: float,
    *,
    area: Hints,
    volume: Hints,
    assertion: str = "area is width times length",
) -> None:
    """Assert that a response contains the area `base` and the volume `base` times `height`.

    `area` and `volume` are the hints for the two fields of the response.
    """
    context.expect(assertion, expected=base, actual=response.area, near=NEAR, hints=area)
    context.expect(
        "volume is area times height",
        expected=base * height,
        actual=response.volume,
        near=NEAR,
        hints=volume,
    )


def boxes(context: CheckContext, count: int) -> list[list[float]]:
    """Return the sides of `count` boxes: fractions, whole numbers, equal sides, and small or large sides.

    A function that handles only one kind of number correctly fails. The first box has three different sides
    with fractions, so a wrong order of the sides is visible.
    """
    side = context.random.number(0.5, 9.0)
    others: list[list[float]] = [
        [*context.random.integers(3, 1, 9)],
        [side, side, context.random.number(0.5, 9.0)],
        context.random.numbers(3, 0.001, 0.5, digits=3),
        context.random.numbers(3, 10.0, 9000.0),
    ]
    return [context.random.numbers(3, 0.5, 9.0), *context.random.shuffled(others)[: count - 1]]
