"""Tests of default values, and of valid and invalid values of fields."""

from __future__ import annotations

import math
from collections.abc import Callable

import genpy
import pytest
from geometry_msgs.msg import Point

from course_pkg.errors import FieldError
from course_pkg.types import Kind, MessageType, compile_message, message_type, service_type

TEXT = """\
int8 i8
uint8 u8
char c
byte b
int64 i64
uint64 u64
float32 f32
float64 f64
bool flag
string word
time t
duration d
uint8[] data
int16[3] three
geometry_msgs/Point[] points
Header header
"""


@pytest.fixture(scope="module")
def mixed() -> MessageType:
    """Return a message type with a field of every kind."""
    return compile_message("course_pkg/Mixed", TEXT)


@pytest.fixture
def refusal(mixed: MessageType) -> Callable[..., FieldError]:
    """Return a function that checks one invalid value and returns the error."""

    def ask(**values: object) -> FieldError:
        with pytest.raises(FieldError) as caught:
            mixed.check({**mixed.default(), **values})
        return caught.value

    return ask


def test_defaults_are_those_of_genpy(mixed: MessageType) -> None:
    """The default values of a message type are equal to the values of a new genpy message."""
    assert mixed.to_message(mixed.default()) == mixed.cls()
    assert mixed.to_values(mixed.cls()) == mixed.default()


def test_fields_have_type_kind_and_parts(mixed: MessageType) -> None:
    """A field has the right type, kind, length, element type and nested fields."""
    fields = {field.name: field for field in mixed.fields}
    assert fields["points"].kind is Kind.ARRAY
    assert fields["points"].type == "geometry_msgs/Point[]"
    assert fields["points"].item is not None
    assert [part.name for part in fields["points"].item.fields] == ["x", "y", "z"]
    assert fields["three"].length == 3
    assert fields["data"].length is None
    assert fields["header"].type == "std_msgs/Header"
    assert [part.kind for part in fields["header"].fields] == [Kind.INTEGER, Kind.TIME, Kind.STRING]


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("i8", -128, 127),
        ("u8", 0, 255),
        ("c", 0, 255),
        ("b", -128, 127),
        ("i64", -(2**63), 2**63 - 1),
        ("u64", 0, 2**64 - 1),
    ],
)
def test_integers_have_the_range_of_their_type(
    mixed: MessageType, refusal: Callable[..., FieldError], name: str, low: int, high: int
) -> None:
    """An integer type's smallest and largest numbers are valid, and numbers outside of this range are not."""
    for edge in (low, high):
        assert mixed.check({**mixed.default(), name: edge})[name] == edge
    for beyond in (low - 1, high + 1):
        assert f"from {low} to {high}" in refusal(**{name: beyond}).allowed


@pytest.mark.parametrize("value", [1.0, True, "1", None, 1.5])
def test_an_integer_field_takes_integers_only(refusal: Callable[..., FieldError], value: object) -> None:
    """An integer field refuses a float, a bool, a string and None."""
    error = refusal(i8=value)
    assert error.field == "i8"
    assert error.hint == ("write 1" if value == 1.0 and isinstance(value, float) else "")


def test_float32_is_kept_as_its_shortest_number(mixed: MessageType) -> None:
    """A float32 value 1.2000000476837158 becomes 1.2."""
    assert mixed.check({**mixed.default(), "f32": 1.2000000476837158})["f32"] == 1.2
    assert mixed.check({**mixed.default(), "f32": 6.240000247955322})["f32"] == 6.2400002


@pytest.mark.parametrize("value", [math.inf, -math.inf, 3.4028234663852886e38, 3.4028235e38, 7])
def test_floats_take_what_fits(mixed: MessageType, value: float) -> None:
    """A float32 field accepts infinity, its largest number, and an int."""
    assert mixed.check({**mixed.default(), "f32": value})["f32"] == pytest.approx(value)


def test_floats_refuse_what_does_not_fit(refusal: Callable[..., FieldError]) -> None:
    """A float field refuses a bool, and a number that is too large."""
    assert "3.4e38" in str(refusal(f32=1e39))
    assert "1.8e308" in str(refusal(f64=10**400))
    assert refusal(f64=True).field == "f64"


def test_times_are_unsigned_and_durations_signed(
    mixed: MessageType, refusal: Callable[..., FieldError]
) -> None:
    """A duration may be negative, but a time may not be negative."""
    assert mixed.check({**mixed.default(), "d": {"secs": -1, "nsecs": 5}})["d"]["secs"] == -1
    assert refusal(t={"secs": -1, "nsecs": 0}).field == "t.secs"
    assert refusal(d={"secs": 0, "nsecs": -1}).field == "d.nsecs"
    assert refusal(t={"secs": 0, "nsecs": 10**9}).field == "t.nsecs"


def test_messages_and_times_may_be_given_as_such(mixed: MessageType) -> None:
    """If a field gets a genpy message or a genpy time, the value is converted to plain values."""
    given = {"t": genpy.Time(1, 2), "points": [Point(1, 2, 3)], "data": b"\x01\x02"}
    checked = mixed.check({**mixed.default(), **given})
    assert checked["t"] == {"secs": 1, "nsecs": 2}
    assert checked["points"] == [{"x": 1.0, "y": 2.0, "z": 3.0}]
    assert checked["data"] == [1, 2]


def test_errors_name_the_path(refusal: Callable[..., FieldError]) -> None:
    """The error for a nested value contains the index of the element and the name of the field."""
    points = [{"x": 0.0, "y": 0.0, "z": 0.0}, {"x": 0.0, "y": 0.0, "z": "high"}]
    assert refusal(points=points).field == "points[1].z"
    assert refusal(data=[0, 256]).field == "data[1]"


def test_a_fixed_array_wants_its_length(refusal: Callable[..., FieldError]) -> None:
    """If an array of fixed length is wrong, the error message contains the given and the expected length."""
    error = refusal(three=[1, 2])
    assert "2 elements were given" in str(error)
    assert "exactly 3" in error.allowed


def test_missing_and_unknown_fields_are_named(mixed: MessageType) -> None:
    """The error message for a misspelt field contains its name, and the name of the most similar field."""
    values = mixed.default()
    del values["f32"]
    with pytest.raises(FieldError, match="f32: this field is missing"):
        mixed.check(values)
    with pytest.raises(FieldError, match="did you mean header"):
        mixed.check({**mixed.default(), "headr": {}})


def test_a_string_holds_what_utf_8_holds(mixed: MessageType, refusal: Callable[..., FieldError]) -> None:
    """A string may contain the character NUL, but not half of a surrogate pair."""
    assert mixed.check({**mixed.default(), "word": "a\x00ä"})["word"] == "a\x00ä"
    assert "surrogate" in str(refusal(word="\ud800"))


def test_invalid_values_in_a_message_are_found(mixed: MessageType) -> None:
    """A message with invalid values raises a FieldError."""
    message = mixed.cls()
    message.points = [None]
    with pytest.raises(FieldError, match=r"points\[0\]"):
        mixed.to_values(message)


def test_an_image_becomes_bytes() -> None:
    """In a genpy message, a list of numbers in a uint8 array becomes bytes."""
    image = message_type("std_msgs/UInt8MultiArray")
    values = {**image.default(), "data": [7] * 100_000}
    assert image.to_message(values).data == b"\x07" * 100_000


def test_an_empty_half_has_no_values() -> None:
    """The value of an empty request is an empty dict."""
    empty = service_type("std_srvs/Empty").request
    assert empty.check({}) == empty.default() == {}
    with pytest.raises(FieldError, match="no fields"):
        empty.check({"data": 1})
