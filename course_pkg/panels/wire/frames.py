"""Where one message of TCPROS ends and the next begins, in all that one side said on a connection.

http://wiki.ros.org/ROS/TCPROS: a connection header, and behind it requests, or replies with their ok byte.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

from course_pkg.graph.probe import header_fields


class Frame(NamedTuple):
    """One message; `at` is its offset in the stream. One that was cut off ends where the bytes end."""

    at: int
    data: bytes


def the_header(stream: bytes) -> Frame | None:
    """Return the connection header with its length, or None where nothing was said."""
    return _frame(stream, 0, 0)


def said_first(stream: bytes) -> dict[str, str]:
    """Return the fields of the connection header."""
    header = the_header(stream)
    return header_fields(header.data) if header else {}


def requests(stream: bytes) -> Iterator[Frame]:
    """Yield what a client sent behind its header."""
    yield from _frames(stream, 0)


def replies(stream: bytes) -> Iterator[Frame]:
    """Yield what a server sent behind its header, each with its ok byte."""
    yield from _frames(stream, 1)


def _frames(stream: bytes, extra: int) -> Iterator[Frame]:
    header = the_header(stream)
    at = len(header.data) if header else 0
    while frame := _frame(stream, at, extra):
        yield frame
        at += len(frame.data)


def _frame(stream: bytes, at: int, extra: int) -> Frame | None:
    """Return the frame at `at`, whose length stands behind `extra` bytes."""
    if at >= len(stream):
        return None
    if at + extra + 4 > len(stream):
        return Frame(at, stream[at:])
    (length,) = struct.unpack_from("<I", stream, at + extra)
    return Frame(at, stream[at : at + extra + 4 + length])
