"""Tests of the conversion between strings and values."""

from __future__ import annotations

import math

import pytest

from course_pkg.errors import FieldError
from course_pkg.types import MessageType, compile_message, message_type, service_type


def parse(type_name: str, text: object) -> object:
    """Convert a string to a value of the given type, and return the value."""
    return compile_message("course_pkg/One", f"{type_name} x\n").parse({"x": text})["x"]


def refused(type_name: str, text: object) -> FieldError:
    """Return the error for an invalid string."""
    with pytest.raises(FieldError) as caught:
        parse(type_name, text)
    return caught.value


@pytest.fixture(scope="module")
def geometry() -> MessageType:
    """Return the request type of the geometry service."""
    return service_type("course_pkg/geometry").request


def test_numbers_are_shown_as_short_as_they_were_typed(geometry: MessageType) -> None:
    """A float32 that was typed as 1.2 is shown as 1.2."""
    texts = {"length": "1.2", "width": "5.2", "height": "8.9"}
    assert geometry.format(geometry.parse(texts)) == texts
    wire = {"length": 1.2000000476837158, "width": 5.199999809265137, "height": 8.899999618530273}
    assert geometry.format(wire) == texts


@pytest.mark.parametrize(
    ("type_name", "text", "value"),
    [
        ("int32", " 42 ", 42),
        ("int32", "+7", 7),
        ("int32", "007", 7),
        ("uint8", "0xff", 255),
        ("float32", "1", 1.0),
        ("float64", ".5", 0.5),
        ("float64", "1e5", 100000.0),
        ("float32", "inf", math.inf),
        ("float32", "-.inf", -math.inf),
        ("float32", "1e-50", 0.0),
        ("bool", "Yes", True),
        ("bool", "off", False),
        ("bool", "1", True),
        ("string", " as it is ", " as it is "),
        ("string", "1.0", "1.0"),
        ("time", "1.5", {"secs": 1, "nsecs": 500_000_000}),
        ("time", "{secs: 1, nsecs: 2}", {"secs": 1, "nsecs": 2}),
        ("duration", "-0.25", {"secs": -1, "nsecs": 750_000_000}),
        ("int32[]", "[1, 2, 3]", [1, 2, 3]),
        ("int32[]", "1, 2", [1, 2]),
        ("int32[]", "", []),
        ("int32[2]", ["1", "2"], [1, 2]),
        ("string[]", "[yes, '1.0', \"a, b\"]", ["yes", "1.0", "a, b"]),
        ("uint8[]", "[0, 255]", [0, 255]),
        ("geometry_msgs/Point", "{x: 1, y: 2, z: 3}", {"x": 1.0, "y": 2.0, "z": 3.0}),
        ("geometry_msgs/Point[]", "{x: 1, y: 2, z: 3}", [{"x": 1.0, "y": 2.0, "z": 3.0}]),
    ],
)
def test_notations_that_can_be_typed(type_name: str, text: object, value: object) -> None:
    """Each notation that a student can type is converted to the right value."""
    assert parse(type_name, text) == value


@pytest.mark.parametrize(
    ("type_name", "text", "words"),
    [
        (
            "float32",
            "abc",
            "x: 'abc' is not a number; expected a float32 from -3.4e38 to 3.4e38, such as 1.5",
        ),
        ("float32", "1,5", "write 1.5"),
        ("float32", "1.5 m", "write 1.5"),
        ("float32", "1e39", "out of range"),
        ("float64", "1e309", "out of range"),
        ("float64", "\N{MINUS SIGN}2", "write -2"),
        ("float64", "1,000,000.5", "write 1000000.5"),
        ("float64", "", "nothing is written here"),
        ("float64", "1_000", "write 1000"),
        ("float64", "٣", "is not a number"),
        ("int8", "200", "expected an int8 from -128 to 127"),
        ("uint16", "-1", "expected a uint16 from 0 to 65535"),
        ("int32", "1.0", "write 1"),
        ("int32", "1.5", "'1.5' is not an integer"),
        ("int32", "1,000", "write 1000"),
        ("int32", "two", "'two' is not an integer"),
        ("bool", "maybe", "expected true or false"),
        ("time", "-1", "x.secs"),
        ("time", "soon", "is not a number of seconds"),
        ("int32[3]", "[1, 2]", "a list of exactly 3 elements"),
        ("int32[]", "[1, a]", "x[1]: 'a' is not an integer"),
        ("int32[]", "[1, 2", "is not well formed"),
        ("geometry_msgs/Point", "{x: 1, y: 2}", "x.z: this field is missing"),
        ("geometry_msgs/Point", "{x: 1, y: 2, zz: 3}", "x.zz: no such field"),
        ("geometry_msgs/Point", "7", "x.7: no such field"),
    ],
)
def test_error_about_an_invalid_string(type_name: str, text: str, words: str) -> None:
    """The error message for an invalid string contains the field, the mistake and the allowed values."""
    assert words in str(refused(type_name, text))


def test_an_error_carries_its_parts() -> None:
    """The error has the attributes field, value, allowed and hint."""
    error = refused("float32", "1,5")
    assert (error.field, error.value, error.hint) == ("x", "1,5", "write 1.5")
    assert error.allowed.startswith("a float32 from")
    assert isinstance(error, ValueError)


def test_nan_equals_itself_in_values() -> None:
    """Two values with NaN at the same position are equal."""
    number = message_type("std_msgs/Float32")
    assert number.parse({"data": "nan"}) == number.parse({"data": ".NaN"})
    assert number.parse(number.format({"data": math.nan})) == number.check({"data": math.nan})
