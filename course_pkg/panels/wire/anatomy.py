"""Splits a stream of TCPROS bytes into frames (a header, requests or replies), and each frame into pieces.

Sources: http://wiki.ros.org/ROS/TCPROS (the framing, the ok byte),
http://wiki.ros.org/ROS/Connection%20Header (the fields), and http://wiki.ros.org/msg (the order of a
message's fields). All numbers are little-endian.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

from course_pkg.panels.wire.pieces import (
    BAD,
    KEY,
    LENGTH,
    MD5,
    OK,
    RAW,
    TEXT,
    VALUE,
    PieceState,
    Reader,
    ShortOfBytes,
)
from course_pkg.ros.protocol.probe import header_fields
from course_pkg.types import Field, Kind, MessageType
from course_pkg.types.fields import integer_range
from course_pkg.types.numbers import float32

ERROR = 400  # At most this many characters of an error message are shown.
ITEMS = 8  # Only this many elements at the beginning of an array are shown separately.
# Format characters of `struct` for signed integers; a capital letter is for the unsigned integer of this
# size.
CODES = {1: "b", 2: "h", 4: "i", 8: "q"}
FLOATS = {"float32": ("<f", 4), "float64": ("<d", 8)}

Pieces = list[PieceState]


class Frame(NamedTuple):
    """One message of the stream; `at` is its offset in the stream.

    The frame of an incomplete message ends at the end of the stream.
    """

    at: int
    data: bytes


def the_header(stream: bytes) -> Frame | None:
    """Return the frame of the connection header, or None if the stream is empty."""
    return _frame(stream, 0, 0)


def header_values(stream: bytes) -> dict[str, str]:
    """Return the fields of the connection header, or {} if the stream is empty."""
    header = the_header(stream)
    return header_fields(header.data) if header else {}


def requests(stream: bytes) -> Iterator[Frame]:
    """Yield the requests that a client sent after its connection header."""
    yield from _frames(stream, 0)


def replies(stream: bytes) -> Iterator[Frame]:
    """Yield the replies that a server sent after its connection header; each reply includes its ok byte."""
    yield from _frames(stream, 1)


def _frames(stream: bytes, extra: int) -> Iterator[Frame]:
    header = the_header(stream)
    at = len(header.data) if header else 0
    while frame := _frame(stream, at, extra):
        yield frame
        at += len(frame.data)


def _frame(stream: bytes, at: int, extra: int) -> Frame | None:
    """Return the frame that begins at the offset `at`.

    The frame begins with `extra` bytes (1 for the ok byte of a reply); then the length field follows.
    """
    if at >= len(stream):
        return None
    if at + extra + 4 > len(stream):
        return Frame(at, stream[at:])
    (length,) = struct.unpack_from("<I", stream, at + extra)
    return Frame(at, stream[at : at + extra + 4 + length])


def header_pieces(data: bytes) -> Pieces:
    """Return the pieces of a connection header: its length, and the length and name=value of each field."""
    reader = Reader(data)
    try:
        reader.number(LENGTH, "length of the whole header")
        while reader.rest:
            _header_field(reader)
    except ShortOfBytes:
        pass  # close() adds the remaining bytes as one piece.
    return reader.close()


def request_pieces(data: bytes, kind: MessageType | None) -> Pieces:
    """Return the pieces of a request: its length field and its message fields."""
    reader = Reader(data)
    try:
        reader.number(LENGTH, "length of the request")
        _body(reader, kind)
    except ShortOfBytes:
        pass
    return reader.close()


def reply_pieces(data: bytes, kind: MessageType | None) -> Pieces:
    """Return the pieces of a reply: the ok byte, the length field, and the response or the error message."""
    reader = Reader(data)
    try:
        worked = data[:1] == b"\1"
        words = "1: the call worked" if worked else "0: the call failed, and an error message follows"
        reader.take(1, OK if worked else BAD, "ok", "uint8", words)
        count = reader.number(LENGTH, "length of the response" if worked else "length of the error")
        if worked:
            _body(reader, kind)
        else:
            _text(reader, count, BAD, "error")
    except ShortOfBytes:
        pass
    return reader.close()


def _header_field(reader: Reader) -> None:
    start = reader.at + 4
    (count,) = struct.unpack_from("<I", reader.data, reader.at) if reader.rest >= 4 else (0,)
    name, _, value = reader.data[start : start + count].decode("utf-8", "replace").partition("=")
    reader.number(LENGTH, "length of the next field")
    role = {"md5sum": MD5, "error": BAD}.get(name, KEY)
    at = reader.at
    reader.take(count, role, name, "name=value")
    reader.say(at, value, ERROR if role == BAD else TEXT)


def _body(reader: Reader, kind: MessageType | None) -> None:
    if kind is None:
        reader.take(reader.rest, RAW, "the body", "", "the type is not known on this computer")
        return
    for field in kind.fields:
        _field(reader, field, field.name)


def _field(reader: Reader, field: Field, name: str) -> None:
    if field.kind is Kind.ARRAY:
        _array(reader, field, name)
    elif field.kind is Kind.STRING:
        count = reader.number(LENGTH, f"length of {name}")
        _text(reader, count, VALUE, name)
    elif field.fields or field.kind is Kind.MESSAGE:
        with reader.group(name, field.type):
            for part in field.fields:
                _field(reader, part, f"{name}.{part.name}")
    else:
        _scalar(reader, field, name)


def _scalar(reader: Reader, field: Field, name: str) -> None:
    code, size = _format(field)
    at = reader.at
    (number,) = struct.unpack(code, reader.take(size, VALUE, name, field.type))
    if field.kind is Kind.BOOL:
        reader.say(at, str(bool(number)))
    else:
        reader.say(at, repr(float32(number)) if field.type == "float32" else repr(number))


def _text(reader: Reader, count: int, role: str, name: str) -> None:
    at = reader.at
    words = reader.take(count, role, name, "string")[:ERROR].decode("utf-8", "replace")
    if role == BAD:
        reader.say(at, words, ERROR)
    else:
        reader.say(at, repr(words))


def _array(reader: Reader, field: Field, name: str) -> None:
    item = field.item
    assert item is not None
    with reader.group(name, field.type):
        count = reader.number(LENGTH, f"elements of {name}") if field.length is None else field.length
        for index in range(min(count, ITEMS)):
            _field(reader, item, f"{name}[{index}]")
        if (more := count - ITEMS) > 0:
            with reader.folded(f"{more:,} more of {name}"):
                _skip(reader, item, more, name)


def _skip(reader: Reader, item: Field, count: int, name: str) -> None:
    """Read `count` elements without a separate piece for each element.

    All numbers are read in one operation, because an image has millions of numbers.
    """
    if item.fields or not item.kind.is_scalar or item.kind is Kind.STRING:
        for _ in range(count):
            before = reader.at
            _field(reader, item, name)
            if reader.at == before:
                # An element without fields has no bytes. The loop ends here: a wrong number of such elements
                # in the data could make the loop very long.
                return
    else:
        reader.take(count * _format(item)[1], RAW, name)


def _format(field: Field) -> tuple[str, int]:
    """Return the `struct` format character of a number type, and the size of the type in bytes."""
    if field.kind is Kind.BOOL:
        return "<B", 1
    if field.type in FLOATS:
        return FLOATS[field.type]
    limits = integer_range(field.type)
    assert limits is not None
    size = (limits[1] - limits[0]).bit_length() // 8
    return "<" + (CODES[size] if limits[0] else CODES[size].upper()), size
