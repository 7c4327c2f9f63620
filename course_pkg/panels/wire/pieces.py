"""The pieces of a message's bytes, each with its place, name and value, and a reader that finds them.

A long piece is folded: a page shows only its beginning and its length.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TypedDict

SHOWN = 144  # bytes that are shown of one piece
MOST = 160  # pieces that are shown of one message
TEXT = 80  # characters that are shown of a value

LENGTH, KEY, MD5, OK, BAD, VALUE, RAW, GROUP = "length", "key", "md5", "ok", "bad", "value", "raw", "group"


class PieceState(TypedDict):
    """A piece for the page."""

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
    """Bytes with one meaning. A GROUP has no bytes of its own: it is the heading of the pieces inside it.

    `at` is the offset in the message, `size` the number of bytes there, and `depth` the indentation.
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
    """The bytes end before the end of the piece that should be read."""


class Reader:
    """Reads `data` from its beginning, and collects the pieces."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0
        self.depth = 0
        self.pieces: list[Piece] = []
        self._silent = 0
        self._folded: int | None = None  # the offset at which the maximum number of pieces was reached

    @property
    def rest(self) -> int:
        """The number of bytes that are left."""
        return len(self.data) - self.at

    def take(self, count: int, role: str, name: str, kind: str = "", value: str | None = None) -> bytes:
        """Read `count` bytes as one piece. Raises ShortOfBytes if there are fewer bytes."""
        if count > self.rest:
            raise ShortOfBytes(f"{name}: {count} bytes are needed, and {self.rest} are left")
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

    def say(self, at: int, value: str, most: int = TEXT) -> None:
        """Set the value of the piece that was read last, if it begins at `at` and is kept."""
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
        """Join all bytes that are read in the block into one piece."""
        start = self.at
        self._silent += 1
        try:
            yield
        finally:
            self._silent -= 1
            if self.at > start:
                self._keep(Piece(RAW, start, self.data[start : self.at], name, "", "", self.depth))

    def close(self) -> list[PieceState]:
        """Return all pieces for the page; the bytes that were not read are the last piece."""
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
    """Return a text, shortened to at most `most` characters."""
    return text if len(text) <= most else f"{text[: most - 1]}…"
