"""The pieces that bytes consist of, each with its place, what it is called, and what it says; and a reader.

Whatever is long is folded: a page shows the beginning of it, and says how much there is.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

SHOWN = 144  # bytes of one piece
MOST = 160  # pieces of one message
WORDS = 80  # characters of a value

LENGTH, KEY, MD5, OK, BAD, VALUE, RAW, GROUP = "length", "key", "md5", "ok", "bad", "value", "raw", "group"


@dataclass(frozen=True)
class Piece:
    """Bytes that say one thing; a GROUP has none of its own, and heads those that lie within it.

    `at` is the offset in the message, `size` the bytes it has there; `depth` how far it is indented.
    """

    role: str
    at: int
    data: bytes
    name: str
    type: str = ""
    value: str = ""
    depth: int = 0
    size: int = -1

    def as_dict(self) -> dict[str, object]:
        """Return it as data for the page."""
        size = len(self.data) if self.size < 0 else self.size
        plain = {"role": self.role, "at": self.at, "size": size, "depth": self.depth, "name": self.name}
        return plain | {"type": self.type, "value": self.value, "hex": self.data[:SHOWN].hex()}


class ShortOfBytes(Exception):
    """The bytes end before what they have to hold."""


class Reader:
    """Reads from the beginning of `data`, and keeps the pieces."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0
        self.depth = 0
        self.pieces: list[Piece] = []
        self._silent = 0
        self._folded: int | None = None  # where the pieces begin that are too many

    @property
    def rest(self) -> int:
        """How many bytes are left."""
        return len(self.data) - self.at

    def take(self, count: int, role: str, name: str, kind: str = "", value: str | None = None) -> bytes:
        """Read `count` bytes as one piece. Raises ShortOfBytes."""
        if count > self.rest:
            raise ShortOfBytes(f"{name}: {count} bytes are due, and {self.rest} are left")
        data = self.data[self.at : self.at + count]
        self._keep(Piece(role, self.at, data, name, kind, "" if value is None else value, self.depth))
        self.at += count
        return data

    def number(self, role: str, name: str) -> int:
        """Read a length or a count: an unsigned integer of 4 bytes, little-endian."""
        at = self.at
        (number,) = struct.unpack("<I", self.take(4, role, name, "uint32"))
        self.say(at, str(number))
        return int(number)

    def say(self, at: int, value: str, most: int = WORDS) -> None:
        """Give the piece that was read last, if it begins at `at` and is kept, its value."""
        if self.pieces and self.pieces[-1].at == at and not self._silent:
            self.pieces[-1] = replace(self.pieces[-1], value=shortened(value, most))

    @contextmanager
    def group(self, name: str, kind: str = "", value: str = "") -> Iterator[None]:
        """Put the pieces of the block below a heading."""
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
        """Make one piece of all that is read in the block."""
        start = self.at
        self._silent += 1
        try:
            yield
        finally:
            self._silent -= 1
            if self.at > start:
                self._keep(Piece(RAW, start, self.data[start : self.at], name, "", "", self.depth))

    def close(self) -> list[dict[str, object]]:
        """Return all pieces for the page; bytes that nobody read are the last one."""
        if self.rest:
            self.take(self.rest, RAW, "the rest", "", "bytes that do not belong to anything before")
        if self._folded is not None:
            data = self.data[self._folded : self.at]
            self.pieces.append(Piece(RAW, self._folded, data, "and so on, folded"))
        return [piece.as_dict() for piece in self.pieces]

    def _keep(self, piece: Piece) -> None:
        if self._silent:
            return
        if len(self.pieces) < MOST:
            self.pieces.append(piece)
        elif self._folded is None:
            self._folded = piece.at


def shortened(text: str, most: int = WORDS) -> str:
    """Return a text in at most `most` characters."""
    return text if len(text) <= most else f"{text[: most - 1]}…"
