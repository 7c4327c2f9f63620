"""What crosses the wire is plain, whatever a student made."""

from __future__ import annotations

import enum
import json
from array import array
from typing import Any

import pytest
from course_pkg.srv import geometryResponse
from geometry_msgs.msg import Point
from rospy import Duration

from course_pkg.examiner.plain import plain


class Everything(float):
    """Says that it equals anything."""

    def __eq__(self, other: object) -> bool:
        """Lie."""
        return True

    __hash__ = float.__hash__


class Colour(enum.IntEnum):
    """A number with a name."""

    RED = 3


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (None, None),
        (True, True),
        ((1, "a", 2.5), [1, "a", 2.5]),
        (b"\x01\xff", [1, 255]),
        (geometryResponse(area=1.5, volume=2.0), {"area": 1.5, "volume": 2.0}),
        ([Point(1.0, 2.0, 3.0)], [{"x": 1.0, "y": 2.0, "z": 3.0}]),
        (Duration(2, 5), {"secs": 2, "nsecs": 5}),
        (array("f", [0.5, 1.5]), [0.5, 1.5]),
        (Colour.RED, 3),
        ({1: {2: 3}}, {"1": {"2": 3}}),
        (object(), {"object": "object"}),
        (..., {"object": "ellipsis"}),
    ],
)
def test_values_become_plain(value: Any, expected: Any) -> None:  # noqa: ANN401
    """Messages become dicts, sequences lists, NumPy numbers numbers, and the rest the name of its type."""
    assert plain(value) == expected
    json.dumps(plain(value))


def test_an_object_equal_to_everything_loses_that() -> None:
    """Equality is decided on the plain value, by plain rules."""
    assert type(plain(Everything(3.0))) is float
    assert plain(Everything(3.0)) != 4.0


def test_what_has_no_end_is_cut() -> None:
    """A list that holds itself, and a long text, do not grow without bounds."""
    endless: list[Any] = []
    endless.append(endless)
    assert "nested too deeply" in json.dumps(plain(endless))
    assert len(plain("x" * 10**6)) < 10**5
