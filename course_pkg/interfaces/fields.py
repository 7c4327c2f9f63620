"""What a field of a message can hold: its kind, its range, what it is made of."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, TypeAlias

# A plain value: bool, int, float, str, a list of plain values, or a dict of them by field name.
Value: TypeAlias = Any
# The same shape with a text for every scalar.
TextTree: TypeAlias = Any

FLOAT32_MAX: float = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
FLOAT64_MAX: float = struct.unpack("<d", b"\xff\xff\xff\xff\xff\xff\xef\x7f")[0]


class Kind(str, Enum):
    """How a field is filled in; the value is its name in a schema."""

    INTEGER = "integer"
    FLOAT = "float"
    BOOL = "bool"
    STRING = "string"
    TIME = "time"
    DURATION = "duration"
    ARRAY = "array"
    MESSAGE = "message"

    @property
    def is_scalar(self) -> bool:
        """Whether one text holds the whole value."""
        return self in (Kind.INTEGER, Kind.FLOAT, Kind.BOOL, Kind.STRING)


@dataclass(frozen=True)
class Constant:
    """A constant of a message type."""

    name: str
    type: str
    value: bool | int | float | str


@dataclass(frozen=True)
class Field:
    """A field of a message, or (with an empty name) an element of an array.

    `low` and `high` bound a number. `length` is that of an array, None where it
    may vary; `item` is an array's element. `fields` are the parts of a message,
    or the `secs` and `nsecs` of a time or duration. `cls` is the class behind a
    message. `help` is the comment on the field in its definition.
    """

    name: str
    type: str
    kind: Kind
    low: int | float | None = None
    high: int | float | None = None
    length: int | None = None
    item: Field | None = None
    fields: tuple[Field, ...] = ()
    cls: Any = field(default=None, repr=False, compare=False)
    help: str = field(default="", repr=False, compare=False)

    @property
    def is_bytes(self) -> bool:
        """Whether genpy holds the array as bytes."""
        return self.item is not None and self.item.type in ("uint8", "char")


def integer_range(type_name: str) -> tuple[int, int] | None:
    """Return the least and the greatest value of an integer type, None if it is no integer type."""
    # ROS 1 keeps two old names that mean the opposite of what C says: byte is signed, char is not.
    name = {"byte": "int8", "char": "uint8"}.get(type_name, type_name)
    unsigned, _, bits = name.rpartition("int")
    if unsigned not in ("", "u") or bits not in ("8", "16", "32", "64"):
        return None
    width = int(bits)
    return (0, 2**width - 1) if unsigned else (-(2 ** (width - 1)), 2 ** (width - 1) - 1)


def builtin_field(name: str, type_name: str, help_text: str = "") -> Field | None:
    """Return the field of a built-in type that is not an array, None for any other type."""
    if limits := integer_range(type_name):
        return Field(name, type_name, Kind.INTEGER, *limits, help=help_text)
    if type_name in ("time", "duration"):
        return Field(name, type_name, Kind(type_name), fields=_clock_fields(type_name), help=help_text)
    if type_name in ("float32", "float64"):
        limit = FLOAT32_MAX if type_name == "float32" else FLOAT64_MAX
        return Field(name, type_name, Kind.FLOAT, -limit, limit, help=help_text)
    if type_name in ("bool", "string"):
        return Field(name, type_name, Kind(type_name), help=help_text)
    return None


def _clock_fields(type_name: str) -> tuple[Field, ...]:
    """Return the two halves: a time is unsigned, a duration signed, and both count nsecs upwards."""
    integer = "uint32" if type_name == "time" else "int32"
    limits = integer_range(integer)
    assert limits is not None
    return (
        Field("secs", integer, Kind.INTEGER, *limits),
        Field("nsecs", integer, Kind.INTEGER, 0, 999_999_999),
    )
