"""A frame shows whether somebody is there, and what is malformed shows nothing."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from course_pkg.shop import frame_points, sees_customer
from course_pkg.shop.frames import HEIGHT, WIDTH


def frame(
    data: bytes, width: int = WIDTH, height: int = HEIGHT, *, step: int = 0, encoding: str = "mono8"
) -> SimpleNamespace:
    """Return what a frame has of a sensor_msgs/Image; without a `step`, rows are as long as their points."""
    return SimpleNamespace(data=data, width=width, height=height, step=step or width, encoding=encoding)


@pytest.mark.parametrize("customers", [0, 1, 2, 3, 12])
def test_whoever_is_drawn_is_seen(customers: int) -> None:
    """The camera of the course and the rule of its specification agree."""
    points = frame_points(customers)
    assert len(points) == WIDTH * HEIGHT
    assert sees_customer(frame(points)) is (customers > 0)


@pytest.mark.parametrize(("dark", "seen"), [(9, False), (10, True), (11, True)])
def test_a_tenth_of_dark_points_is_enough(dark: int, seen: bool) -> None:
    """At least a tenth are below 96; 96 itself is not."""
    assert sees_customer(frame(bytes([95] * dark + [96] * (100 - dark)), 10, 10)) is seen


def test_what_fills_up_a_row_is_no_point() -> None:
    """Rows may be longer than their points."""
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
def test_what_is_malformed_is_no_question(broken: SimpleNamespace) -> None:
    """It is neither somebody nor nobody."""
    with pytest.raises(ValueError, match=r"\w"):
        sees_customer(broken)
