"""The responses of /getGeometry, a service that measures boxes."""

from __future__ import annotations

from course_pkg.checking.assertions import Hints
from course_pkg.checking.context import CheckContext
from course_pkg.checking.plain_values import Message


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
    context.expect(assertion, expected=base, actual=response.area, near=1e-3, hints=area)
    context.expect(
        "volume is area times height",
        expected=base * height,
        actual=response.volume,
        near=1e-3,
        hints=volume,
    )
