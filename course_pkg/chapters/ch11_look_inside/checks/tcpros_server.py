"""A TCPROS server that records the first mistake of a client, and can send its response byte by byte.

The protocol is described at http://wiki.ros.org/ROS/TCPROS. The server is not registered at the master; the
client gets the address as an argument.
"""

from __future__ import annotations

import select
import socket
import struct
import threading
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

from course_pkg.waiting import wait_until

LONGEST = 4096  # LONGEST is the maximum number of bytes of a header or of a request.
TIMEOUT = 8.0  # TIMEOUT is the time limit in s for the next bytes of a client on a busy machine.
EARLY = 0.1  # The server waits this time in s to see whether the client sends its request too early.
# After the response, the client must close the connection within this time in s, even on a busy machine.
LINGER = 3.0
# During a slow response, the server waits up to this time in s in total until the client has read the bytes.
UNREAD = 1.0
PIECE = 12  # If the server refuses a call, it sends its error message in pieces of this number of bytes.
REQUEST = 12  # Three float32 values have this many bytes.


@dataclass
class Conversation:
    """The data that one client has sent; `mistake` is the client's first mistake."""

    header: dict[str, str] = field(default_factory=dict)
    sides: list[float] = field(default_factory=list)
    mistake: str = ""
    over: bool = False
    left_open: bool = False  # `left_open` is True if the client left the connection open after the response.


class ProtocolMistake(Exception):
    """The client has sent something that TCPROS does not allow."""


class TcprosServer:
    """Responds to geometry calls with the area and the volume in `numbers`.

    If `refusal` is not empty, the server sends this error message instead of a response, and it sends its
    bytes in several pieces. If `in_handshake` is True, the server sends the error message already in the
    connection header.

    If `slowly` is True, the server sends each byte separately. Its header then has only the field callerid:
    TCPROS requires no other field of a server, but the clients of ROS refuse such a header.
    """

    def __init__(
        self,
        kind: type,
        numbers: tuple[float, float],
        *,
        refusal: str = "",
        in_handshake: bool = False,
        slowly: bool = False,
        host: str = "localhost",
    ) -> None:
        self.conversations: list[Conversation] = []
        self._kind, self._numbers = kind, numbers
        self._refusal, self._in_handshake, self._slowly = refusal, in_handshake, slowly
        self._host = host
        self._listener = socket.create_server((host, 0))

    @property
    def uri(self) -> str:
        """The address of the service, in the same format as the master's response."""
        return f"rosrpc://{self._host}:{self._listener.getsockname()[1]}"

    def __enter__(self) -> TcprosServer:
        threading.Thread(target=self._accept, daemon=True).start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):  # When the listening socket is closed, accept() raises OSError.
            while True:
                sock, _ = self._listener.accept()
                self.conversations.append(Conversation())
                threading.Thread(
                    target=self._attend, args=(sock, self.conversations[-1]), daemon=True
                ).start()

    def _attend(self, sock: socket.socket, conversation: Conversation) -> None:
        with sock:
            sock.settimeout(TIMEOUT)
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            try:
                self._answer(sock, conversation)
            except (ProtocolMistake, OSError) as error:
                conversation.mistake = conversation.mistake or str(error)
            finally:
                conversation.over = True

    def _answer(self, sock: socket.socket, conversation: Conversation) -> None:
        conversation.header = _header(sock)
        if self._in_handshake:
            self._send(sock, _sized(_sized(f"error={self._refusal}".encode())))
            return
        if not (self._slowly or self._refusal):
            _nothing_yet(sock)
        fields = {"callerid": "/odd"}
        if not self._slowly:
            fields.update(md5sum=str(getattr(self._kind, "_md5sum", "")), type="course_pkg/geometry")
        self._send(sock, _sized(b"".join(_sized(f"{key}={value}".encode()) for key, value in fields.items())))
        conversation.sides = _sides(sock)
        if self._refusal:
            self._send(sock, b"\0" + _sized(self._refusal.encode()))
        else:
            self._send(sock, b"\1" + _sized(struct.pack("<2f", *self._numbers)))
            conversation.left_open = not select.select([sock], [], [], LINGER)[0]

    def _send(self, sock: socket.socket, data: bytes) -> None:
        if not (self._slowly or self._refusal):
            sock.sendall(data)
            return
        deadline = time.monotonic() + UNREAD
        size = 1 if self._slowly else PIECE
        for start in range(0, len(data), size):
            sock.sendall(data[start : start + size])
            time.sleep(0.0005)  # Without this pause, TCP would send several bytes together.
            wait_until(lambda: not _has_unread_bytes(sock), deadline - time.monotonic(), interval=0.001)


def _has_unread_bytes(sock: socket.socket) -> bool:
    """Return whether the client on this computer has unread bytes, according to /proc/net/tcp."""
    ends = [f":{port:04X}" for port in (sock.getpeername()[1], sock.getsockname()[1])]
    for line in Path("/proc/net/tcp").read_text().splitlines()[1:]:
        _, local, remote, _, queues, *_ = line.split()
        if local.endswith(ends[0]) and remote.endswith(ends[1]):
            return not queues.endswith(":00000000")
    return False


def _header(sock: socket.socket) -> dict[str, str]:
    length = _number(sock, "nothing")
    if length > LONGEST:
        big = int.from_bytes(length.to_bytes(4, "little"), "big")
        raise ProtocolMistake("big-endian header" if big <= LONGEST else "no length of the header")
    body = _exactly(sock, length, "short header")
    fields = {}
    while body:
        end = 4 + int.from_bytes(body[:4], "little")
        if end > len(body):
            raise ProtocolMistake("no length of the header")
        name, _, value = body[4:end].decode("utf-8", "replace").partition("=")
        fields[name], body = value, body[end:]
    return fields


def _nothing_yet(sock: socket.socket) -> None:
    """Raise ProtocolMistake if the client sends its request before it has received the server's header."""
    if select.select([sock], [], [], EARLY)[0] and sock.recv(1, socket.MSG_PEEK):
        raise ProtocolMistake("early request")


def _sides(sock: socket.socket) -> list[float]:
    length = _number(sock, "no request")
    if length == REQUEST << 24:
        raise ProtocolMistake("big-endian length")
    if length != REQUEST:
        raise ProtocolMistake(
            "no length of the request" if length > LONGEST else f"a request of {length} bytes"
        )
    return list(struct.unpack("<3f", _exactly(sock, REQUEST, "short request")))


def _number(sock: socket.socket, mistake: str) -> int:
    return int.from_bytes(_exactly(sock, 4, mistake), "little")


def _exactly(sock: socket.socket, count: int, mistake: str) -> bytes:
    data = b""
    while len(data) < count:
        try:
            part = sock.recv(count - len(data))
        except TimeoutError:
            part = b""
        if not part:
            raise ProtocolMistake(mistake)
        data += part
    return data


def _sized(data: bytes) -> bytes:
    return struct.pack("<I", len(data)) + data
