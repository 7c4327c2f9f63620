"""The paths of the numbers in a message, such as `data`, `pose.position.x` and `position[0]`."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

import genpy

from course_pkg.ros.node.type_lookup import Message
from course_pkg.types import Field, Kind, MessageType

ELEMENTS = 8  # For an array, at most this number of elements is listed.
# For a message, at most this number of paths is listed: nested arrays may contain thousands of numbers.
MOST = 200

# A measurement is most probably a float, and least probably a bool.
_NUMBERS = (Kind.FLOAT, Kind.INTEGER, Kind.BOOL)
# These fields are not measurements: a measurement's time and frame, and the limits of the sensor.
_HEADER = "std_msgs/Header"
_SETTING = re.compile(r"(^|_)(min|max|increment|scan_time|field_of_view)(_|$)")


def numbers(message: MessageType) -> list[str]:
    """Return the paths of all numbers in a message.

    For an array, the result contains only the paths of the first elements.
    """
    return [path for path, _ in _first_numbers(message)]


def measurement(message: MessageType) -> str:
    """Return the path of the number that is most probably the measurement, or "" if there is no number.

    Fields in a std_msgs/Header and settings of the sensor, such as `range_min`, are not measurements. From
    all other fields, the function selects the first float. Without a float, it selects the first integer, and
    without an integer, the first bool. If the message has no other fields, the function returns the first
    number in the message.
    """
    measured = [found for found in _first_numbers(message, _HEADER) if not _SETTING.search(found[0])]
    by_kind = [path for wanted in _NUMBERS for path, kind in measured if kind is wanted]
    return next(iter(by_kind or numbers(message)), "")


def extractor(message: MessageType, path: str) -> Callable[[bytes], float]:
    """Return a function that reads the number at the path `path` from a message's bytes.

    If the message does not contain the number, the returned function returns NaN. Raises ValueError if the
    type does not have this path.
    """
    if path not in numbers(message):
        raise ValueError(f"{message.name} has no number at the path {path!r}")
    steps = [int(step) if step.isdigit() else step for step in re.findall(r"\w+", path)]
    cls = message.cls

    def extract(body: bytes) -> float:
        try:
            return float(_walk(cls().deserialize(body), steps))
        except (genpy.DeserializationError, IndexError, TypeError, ValueError):
            return math.nan

    return extract


def _walk(value: Message, steps: Sequence[int | str]) -> Message:
    for step in steps:
        value = value[step] if isinstance(step, int) else getattr(value, step)
    return value


def _first_numbers(message: MessageType, without: str = "") -> Iterator[tuple[str, Kind]]:
    """Yield the paths and kinds of the first `MOST` numeric fields, but skip the message type `without`."""
    every = (found for field in message.fields for found in _paths(field, field.name, without))
    return islice(every, MOST)


def _paths(field: Field, path: str, without: str) -> Iterator[tuple[str, Kind]]:
    if field.kind in _NUMBERS:
        yield path, field.kind
    elif field.kind is Kind.ARRAY and field.item is not None:
        for index in range(min(ELEMENTS, ELEMENTS if field.length is None else field.length)):
            yield from _paths(field.item, f"{path}[{index}]", without)
    elif field.kind is Kind.MESSAGE and field.type != without:
        for each in field.fields:
            yield from _paths(each, f"{path}.{each.name}", without)
