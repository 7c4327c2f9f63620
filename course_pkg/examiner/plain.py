"""Whatever student code hands over, as plain data: it is all that crosses the wire."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

Plain: TypeAlias = Any  # None, bool, int, float, str, and lists and dicts of them
Value: TypeAlias = Any  # whatever a student's code made
Message: TypeAlias = Any  # a message, request or response that genpy generated; it has no types
ServiceClass: TypeAlias = Any  # the same for a service type

DEPTH = 12
ITEMS = 10_000


def plain(value: Value, depth: int = DEPTH) -> Plain:
    """Return `value` as None, bool, int, float, str, list and dict.

    A ROS message becomes a dict of its fields, bytes a list of integers, a NumPy scalar a number.
    What has no plain form becomes {"object": name of its type}: equal to nothing that a check expects.
    """
    kind = type(value)
    if value is None or kind in (bool, int, float):
        return value
    if kind is str:
        return value[:ITEMS]
    if depth == 0:
        return {"object": f"{kind.__name__}, nested too deeply"}
    if kind in (bytes, bytearray):
        return list(value[:ITEMS])
    return _compound(value, depth - 1)


def _compound(value: Value, depth: int) -> Plain:
    if isinstance(value, Mapping):
        return {str(key): plain(item, depth) for key, item in list(value.items())[:ITEMS]}
    if isinstance(value, (list, tuple)):
        return [plain(item, depth) for item in value[:ITEMS]]
    if hasattr(value, "secs") and hasattr(value, "nsecs"):  # a time or a duration of genpy
        return {"secs": value.secs, "nsecs": value.nsecs}
    if hasattr(value, "_slot_types"):  # a message of genpy
        return {name: plain(getattr(value, name), depth) for name in value.__slots__}
    if hasattr(value, "tolist"):  # an array, or a number of NumPy's
        return plain(value.tolist(), depth)
    return _exact(value)


def _exact(value: Value) -> Plain:
    """Strip a number or a text of its subclass, such as an IntEnum."""
    if isinstance(value, int):
        return int.__int__(value)
    if isinstance(value, float):
        return float.__float__(value)
    if isinstance(value, str):
        return str.__str__(value)[:ITEMS]
    return {"object": type(value).__name__}
