"""The fields of a message, with the kind and the range of each field."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    import genpy

# A plain value can be converted to JSON. An array is a sequence of plain values, and a message is a mapping
# from field names to plain values.
Plain: TypeAlias = "bool | int | float | str | Sequence[Plain] | Mapping[str, Plain] | None"
# A string tree has the structure of a plain value, but with a string instead of each number and bool.
StringTree: TypeAlias = "str | Sequence[StringTree] | Mapping[str, StringTree]"

FLOAT32_MAX: float = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
FLOAT64_MAX: float = struct.unpack("<d", b"\xff\xff\xff\xff\xff\xff\xef\x7f")[0]


class MessageClass(Protocol):
    """A message class that genpy generated."""

    @property
    def _type(self) -> str: ...
    @property
    def _md5sum(self) -> str: ...
    @property
    def _full_text(self) -> str: ...
    @property
    def _slot_types(self) -> Sequence[str]: ...

    __slots__: list[str]

    def __call__(self) -> genpy.Message:
        """Return a message with default values."""


class ServiceClass(Protocol):
    """A service class that genpy generated."""

    @property
    def _type(self) -> str: ...
    @property
    def _md5sum(self) -> str: ...
    @property
    def _request_class(self) -> MessageClass: ...
    @property
    def _response_class(self) -> MessageClass: ...


class Kind(str, Enum):
    """The kind of input that a field needs; the enum's value is the name of the kind in a schema."""

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
        """Whether a value of this kind is a single number, bool or string."""
        return self in (Kind.INTEGER, Kind.FLOAT, Kind.BOOL, Kind.STRING)


@dataclass(frozen=True)
class Constant:
    """A constant of a message type."""

    name: str
    type: str
    value: bool | int | float | str


@dataclass(frozen=True)
class Field:
    """A field of a message, or an element of an array; the name of an element is empty.

    `low` and `high` are the limits of a number. `length` is the length of an array, or None if it may vary;
    `item` describes an array's element. `fields` are the fields of a message, or `secs` and `nsecs` of a time
    or duration. `cls` is the class of a message. `help` is the comment on the field in its definition.
    """

    name: str
    type: str
    kind: Kind
    low: int | float | None = None
    high: int | float | None = None
    length: int | None = None
    item: Field | None = None
    fields: tuple[Field, ...] = ()
    cls: MessageClass | None = field(default=None, repr=False, compare=False)
    help: str = field(default="", repr=False, compare=False)

    @property
    def is_bytes(self) -> bool:
        """Whether genpy stores the array as bytes."""
        return self.item is not None and self.item.type in ("uint8", "char")


def elements(value: Plain) -> Sequence[Plain]:
    """Return the elements of an array's value."""
    assert isinstance(value, Sequence)
    return value


def members(value: Plain) -> Mapping[str, Plain]:
    """Return the values of a message's fields by name, or the values of a time's secs and nsecs."""
    assert isinstance(value, Mapping)
    return value


def integer_range(type_name: str) -> tuple[int, int] | None:
    """Return the smallest and the largest value of an integer type, or None for another type."""
    # In ROS 1, unlike in C, the old type byte is signed, and the old type char is unsigned.
    name = {"byte": "int8", "char": "uint8"}.get(type_name, type_name)
    unsigned, _, bits = name.rpartition("int")
    if unsigned not in ("", "u") or bits not in ("8", "16", "32", "64"):
        return None
    width = int(bits)
    return (0, 2**width - 1) if unsigned else (-(2 ** (width - 1)), 2 ** (width - 1) - 1)


def builtin_field(name: str, type_name: str, help_text: str = "") -> Field | None:
    """Return the field of a built-in type that is not an array, or None for any other type."""
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
    """Return the fields secs and nsecs; secs is signed only in a duration, and nsecs is never negative."""
    integer = "uint32" if type_name == "time" else "int32"
    limits = integer_range(integer)
    assert limits is not None
    return (
        Field("secs", integer, Kind.INTEGER, *limits),
        Field("nsecs", integer, Kind.INTEGER, 0, 999_999_999),
    )
