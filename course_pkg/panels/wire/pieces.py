"""A reader that splits the bytes of a message into pieces; each piece has an offset, a name and a value.

For a long piece, a page shows only the beginning and the length.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TypedDict

SHOWN = 144  # At most this many bytes of a piece are shown.
MOST = 160  # At most this many pieces of a message are shown.
TEXT = 80  # At most this many characters of a value are shown.

LENGTH, KEY, MD5, OK, BAD, VALUE, RAW, GROUP = "length", "key", "md5", "ok", "bad", "value", "raw", "group"


class PieceState(TypedDict):
    """The data of one Piece for the page."""

    role: str
    at: int
    size: int
    depth: int
    name: str
    type: str
    value: str
    hex: str


@dataclass(frozen=True)
class Piece:
    """A range of bytes with one meaning, such as a length or a field.

    A piece with the role GROUP is a heading. The pieces below the heading have a larger `depth`.

    `at` is the offset in the message, `size` is the number of bytes, and `depth` is the indentation.
    """

    role: str
    at: int
    data: bytes
    name: str
    type: str = ""
    value: str = ""
    depth: int = 0
    size: int = -1

    def state(self) -> PieceState:
        """Return the piece for the page."""
        return {
            "role": self.role,
            "at": self.at,
            "size": len(self.data) if self.size < 0 else self.size,
            "depth": self.depth,
            "name": self.name,
            "type": self.type,
            "value": self.value,
            "hex": self.data[:SHOWN].hex(),
        }


class ShortOfBytes(Exception):
    """The data end before the end of a piece."""


class Reader:
    """Reads the bytes `data` from the beginning to the end, and collects the pieces."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0
        self.depth = 0
        self.pieces: list[Piece] = []
        self._silent = 0
        # The reader already has `MOST` pieces; all bytes from the offset `_folded` on become one piece.
        self._folded: int | None = None

    @property
    def rest(self) -> int:
        """The number of bytes that have not been read."""
        return len(self.data) - self.at

    def take(self, count: int, role: str, name: str, kind: str = "", value: str | None = None) -> bytes:
        """Read `count` bytes as one piece. Raises ShortOfBytes if fewer bytes are left."""
        if count > self.rest:
            raise ShortOfBytes(f"{name}: {count} bytes are needed, and {self.rest} are left")
        data = self.data[self.at : self.at + count]
        self._keep(Piece(role, self.at, data, name, kind, "" if value is None else value, self.depth))
        self.at += count
        return data

    def number(self, role: str, name: str) -> int:
        """Read a length or a count, which is an unsigned integer of 4 bytes in little-endian order."""
        at = self.at
        (number,) = struct.unpack("<I", self.take(4, role, name, "uint32"))
        self.say(at, str(number))
        return int(number)

    def say(self, at: int, value: str, most: int = TEXT) -> None:
        """Set the value of the last stored piece.

        Do nothing if this piece does not begin at the offset `at`.
        """
        if self.pieces and self.pieces[-1].at == at and not self._silent:
            self.pieces[-1] = replace(self.pieces[-1], value=shortened(value, most))

    @contextmanager
    def group(self, name: str, kind: str = "", value: str = "") -> Iterator[None]:
        """Put all pieces that are read in the `with` block below the heading `name`."""
        start, place = self.at, len(self.pieces)
        self._keep(Piece(GROUP, start, b"", name, kind, value, self.depth, 0))
        self.depth += 1
        try:
            yield
        finally:
            self.depth -= 1
            if place < len(self.pieces) and self.pieces[place].role == GROUP:
                self.pieces[place] = replace(self.pieces[place], size=self.at - start)

    @contextmanager
    def folded(self, name: str) -> Iterator[None]:
        """Combine all bytes that are read in the `with` block into one piece."""
        start = self.at
        self._silent += 1
        try:
            yield
        finally:
            self._silent -= 1
            if self.at > start:
                self._keep(Piece(RAW, start, self.data[start : self.at], name, "", "", self.depth))

    def close(self) -> list[PieceState]:
        """Return all pieces for the page. All unread bytes become one piece at the end."""
        if self.rest:
            self.take(self.rest, RAW, "the rest", "", "bytes that belong to no other piece")
        if self._folded is not None:
            data = self.data[self._folded : self.at]
            self.pieces.append(Piece(RAW, self._folded, data, "more pieces, folded"))
        return [piece.state() for piece in self.pieces]

    def _keep(self, piece: Piece) -> None:
        if self._silent:
            return
        if len(self.pieces) < MOST:
            self.pieces.append(piece)
        elif self._folded is None:
            self._folded = piece.at


def shortened(text: str, most: int = TEXT) -> str:
    """Return the text; cut a text that is longer than `most` characters, and end it with "…"."""
    return text if len(text) <= most else f"{text[: most - 1]}…"
