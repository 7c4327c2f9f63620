"""Convert values of student code into plain data (JSON values), the only data that the channel transmits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias, TypeVar

from course_pkg.errors import CheckError
from course_pkg.ros.protocol.json_channel import Json

Reply: TypeAlias = dict[str, Json]  # These are the fields of a reply on the channel.
Value: TypeAlias = Any  # This is a value that student code created.
Message: TypeAlias = Any  # A message, request or response; genpy generates no type annotations.
# The fields of a message as plain data; the definition of the message contains the types of the fields.
Fields: TypeAlias = dict[str, Any]
ServiceClass: TypeAlias = Any  # This is a service or message class of genpy.
Item = TypeVar("Item")

DEPTH = 12
ITEMS = 10_000


def of_kind(kind: type[Item], value: Json, name: str) -> Item:
    """Return the value, which must be an instance of the class `kind`.

    Raises CheckError for a value of another class. Such a value means that student code has changed an object
    of the check in the kernel.
    """
    if not isinstance(value, kind):
        raise CheckError(
            f"{name} has changed and is not a {kind.__name__} any more. Restart the kernel, "
            "and run the cells again."
        )
    return value


def plain(value: Value, depth: int = DEPTH) -> Json:
    """Return `value` as plain data, made of None, bool, int, float, str, list and dict.

    A ROS message becomes a dict of its fields, bytes become a list of integers, and a NumPy scalar becomes a
    number. Any other value becomes {"object": name of its type}; no check expects this value.
    """
    kind = type(value)
    if value is None or (isinstance(value, (bool, int, float)) and kind in (bool, int, float)):
        return value
    if isinstance(value, str) and kind is str:
        return value[:ITEMS]
    if depth == 0:
        return {"object": f"{kind.__name__}, nested too deeply"}
    if kind in (bytes, bytearray):
        return list(value[:ITEMS])
    return _compound(value, depth - 1)


def fields_of(message: Message) -> Fields:
    """Return a dict with the fields of a message, request or response as plain data."""
    return {name: plain(getattr(message, name)) for name in message.__slots__}


def _compound(value: Value, depth: int) -> Json:
    if isinstance(value, Mapping):
        return {str(key): plain(item, depth) for key, item in list(value.items())[:ITEMS]}
    if isinstance(value, (list, tuple)):
        return [plain(item, depth) for item in value[:ITEMS]]
    if hasattr(value, "secs") and hasattr(value, "nsecs"):  # The value is a time or a duration of genpy.
        return {"secs": value.secs, "nsecs": value.nsecs}
    if hasattr(value, "_slot_types"):  # The value is a message of genpy.
        return {name: plain(getattr(value, name), depth) for name in value.__slots__}
    if hasattr(value, "tolist"):  # The value is an array or a number of NumPy.
        return plain(value.tolist(), depth)
    return _exact(value)


def _exact(value: Value) -> Json:
    """Return a number or a string as a value of its base class; an IntEnum becomes an int."""
    if isinstance(value, int):
        return int(int.__int__(value))
    if isinstance(value, float):
        return float(float.__float__(value))
    if isinstance(value, str):
        return str.__str__(value)[:ITEMS]
    return {"object": type(value).__name__}
