"""A server of TCPROS that says what it was told wrongly, and can answer a byte at a time.

http://wiki.ros.org/ROS/TCPROS. It is registered nowhere: who calls it has its address.
"""

from __future__ import annotations

import socket
import struct
import threading
import time
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType

LONGEST = 4096  # bytes of a header, or of a request
PATIENCE = 3.0  # s for a client to say what is due, on a machine that is busy
SIDES = 12  # bytes of three float32


@dataclass
class Heard:
    """What a client said; `slip` names the first thing that was wrong in it."""

    header: dict[str, str] = field(default_factory=dict)
    sides: list[float] = field(default_factory=list)
    slip: str = ""
    over: bool = False  # whether the conversation is


class Wrong(Exception):
    """The client said something that cannot be."""


class OddServer:
    """Answers one geometry call after the other with `area` and `volume`, until the block ends.

    With `refuses` it answers with these words instead, with `turns_away` already in the handshake; `drips`
    sends each byte by itself.
    """

    def __init__(
        self,
        kind: type,
        numbers: tuple[float, float],
        *,
        refuses: str = "",
        turns_away: str = "",
        drips: bool = False,
    ) -> None:
        self.heard: list[Heard] = []
        self._kind, self._numbers = kind, numbers
        self._refuses, self._turns_away, self._drips = refuses, turns_away, drips
        self._listener = socket.create_server(("127.0.0.1", 0))

    @property
    def uri(self) -> str:
        """Its address, as the master would give it."""
        return f"rosrpc://localhost:{self._listener.getsockname()[1]}"

    def __enter__(self) -> OddServer:
        threading.Thread(target=self._accept, daemon=True).start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):  # closed: over
            while True:
                sock, _ = self._listener.accept()
                self.heard.append(Heard())
                threading.Thread(target=self._attend, args=(sock, self.heard[-1]), daemon=True).start()

    def _attend(self, sock: socket.socket, heard: Heard) -> None:
        with sock:
            sock.settimeout(PATIENCE)
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            try:
                self._converse(sock, heard)
            except (Wrong, OSError) as error:
                heard.slip = heard.slip or str(error)
            finally:
                heard.over = True

    def _converse(self, sock: socket.socket, heard: Heard) -> None:
        heard.header = _header(sock)
        if self._turns_away:
            self._send(sock, _sized(_sized(f"error={self._turns_away}".encode())))
            return
        fields = {
            "callerid": "/odd",
            "md5sum": str(getattr(self._kind, "_md5sum", "")),
            "type": "course_pkg/geometry",
        }
        self._send(sock, _sized(b"".join(_sized(f"{key}={value}".encode()) for key, value in fields.items())))
        heard.sides = _sides(sock)
        if self._refuses:
            self._send(sock, b"\0" + _sized(self._refuses.encode()))
        else:
            self._send(sock, b"\1" + _sized(struct.pack("<2f", *self._numbers)))

    def _send(self, sock: socket.socket, data: bytes) -> None:
        if not self._drips:
            sock.sendall(data)
            return
        for each in data:
            sock.sendall(bytes([each]))
            time.sleep(0.0005)  # the protocol allows any pace; TCP would join bytes that come faster


def _header(sock: socket.socket) -> dict[str, str]:
    length = _number(sock, "nothing")
    if length > LONGEST:
        big = int.from_bytes(length.to_bytes(4, "little"), "big")
        raise Wrong("big-endian header" if big <= LONGEST else "no length of the header")
    body = _exactly(sock, length, "short header")
    fields = {}
    while body:
        end = 4 + int.from_bytes(body[:4], "little")
        if end > len(body):
            raise Wrong("no length of the header")
        name, _, value = body[4:end].decode("utf-8", "replace").partition("=")
        fields[name], body = value, body[end:]
    return fields


def _sides(sock: socket.socket) -> list[float]:
    length = _number(sock, "no request")
    if length == SIDES << 24:
        raise Wrong("big-endian length")
    if length != SIDES:
        raise Wrong("no length of the request" if length > LONGEST else f"a request of {length} bytes")
    return list(struct.unpack("<3f", _exactly(sock, SIDES, "short request")))


def _number(sock: socket.socket, otherwise: str) -> int:
    return int.from_bytes(_exactly(sock, 4, otherwise), "little")


def _exactly(sock: socket.socket, count: int, otherwise: str) -> bytes:
    data = b""
    while len(data) < count:
        try:
            part = sock.recv(count - len(data))
        except TimeoutError:
            part = b""
        if not part:
            raise Wrong(otherwise)
        data += part
    return data


def _sized(data: bytes) -> bytes:
    return struct.pack("<I", len(data)) + data
