"""Values from the student's code are converted to plain data."""

from __future__ import annotations

import enum
import json
from array import array

import pytest
from course_pkg.srv import geometryResponse
from geometry_msgs.msg import Point
from rospy import Duration

from course_pkg.checking.plain_values import Value, plain
from course_pkg.ros.protocol.json_channel import Json


class Everything(float):
    """An object that is equal to every value."""

    def __eq__(self, other: object) -> bool:
        """Return True for every value."""
        return True

    __hash__ = float.__hash__


class Colour(enum.IntEnum):
    """A number that is also a member of an enumeration."""

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
def test_values_become_plain(value: Value, expected: Json) -> None:
    """A message becomes a dict, a sequence becomes a list, and an unknown object becomes its type's name."""
    assert plain(value) == expected
    json.dumps(plain(value))


def test_number_with_a_wrong_eq_becomes_a_plain_number() -> None:
    """A number with a wrong __eq__ becomes a plain number."""
    assert type(plain(Everything(3.0))) is float
    assert plain(Everything(3.0)) != 4.0


def test_endless_values_are_cut() -> None:
    """The conversion shortens a long string, and a list that contains itself."""
    endless: list[Value] = []
    endless.append(endless)
    assert "nested too deeply" in json.dumps(plain(endless))
    assert len(plain("x" * 10**6)) < 10**5
