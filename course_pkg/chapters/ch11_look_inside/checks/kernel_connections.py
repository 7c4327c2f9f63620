"""Connections between the kernel and the check: the check receives bytes, or sends bytes in pieces."""

from __future__ import annotations

import fcntl
import secrets
import select
import socket
import struct
import termios
import threading
from collections.abc import Sequence
from contextlib import suppress
from types import TracebackType

from course_pkg.waiting import wait_until

# The check waits up to this time in s until the client has read a piece. A client that only peeks at the
# bytes does not remove them from the socket.
PEEKING = 0.4
CONNECTING = 5.0  # CONNECTING is the time limit in s for the kernel to connect.


def _listener() -> tuple[str, socket.socket]:
    """Return the name of a new socket, and the socket, which listens for one connection.

    The name is in Linux's abstract namespace. The socket needs no file, and can be used only in this network
    namespace.
    """
    name = f"course-{secrets.token_hex(8)}"
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(f"\0{name}")
    listener.listen(1)
    listener.settimeout(CONNECTING)
    return name, listener


class Receiver:
    """Receives the bytes that the kernel sends through one connection."""

    def __init__(self) -> None:
        self.name, self._listener = _listener()
        self._data = b""
        # A thread receives the bytes, because otherwise a long answer could fill the socket and block.
        self._thread = threading.Thread(target=self._receive, daemon=True)

    def __enter__(self) -> Receiver:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._listener.close()

    def received(self) -> bytes:
        """Return all bytes of the connection, or no bytes if the kernel did not connect."""
        self._thread.join(2 * CONNECTING)
        return self._data

    def _receive(self) -> None:
        with suppress(OSError):
            sock, _ = self._listener.accept()
            with sock:
                sock.settimeout(CONNECTING)
                while chunk := sock.recv(4096):
                    self._data += chunk


class OtherEnd:
    """The server to which the student's socket connects.

    The object sends `pieces`, and keeps the connection open until the `with` block ends.

    The server sends each piece after the client has read the previous piece. Therefore, a client that reads
    only once gets only one piece. `pause` is the time in s before each piece.
    """

    def __init__(self, pieces: Sequence[bytes], *, closes: bool = False, pause: float = 0.0) -> None:
        self.name, self._listener = _listener()
        self._pieces, self._closes, self._pause = pieces, closes, pause
        self._over = threading.Event()
        self._sock: socket.socket | None = None
        self._sending = threading.Thread(target=self._send, daemon=True)

    def __enter__(self) -> OtherEnd:
        self._sending.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._sending.join()
        self._listener.close()

    def is_open(self) -> bool:
        """Return whether the client's socket is open."""
        poll = select.poll()
        if self._sock is not None:
            poll.register(self._sock, 0)
        return not any(seen & select.POLLHUP for _, seen in poll.poll(0))

    def has_more(self) -> bool:
        """Return whether the client's socket contains unread bytes."""
        with suppress(OSError):
            return bool(self._sock and _unread(self._sock))
        return False

    def _send(self) -> None:
        # If the kernel closes its socket or does not connect, socket methods raise an OSError.
        with suppress(OSError):
            sock, _ = self._listener.accept()
            with sock:
                self._sock = sock
                for piece in self._pieces:
                    self._over.wait(self._pause)
                    sock.sendall(piece)
                    wait_until(lambda: not _unread(sock), PEEKING, 0.005, self._over)
                if self._closes:
                    sock.shutdown(socket.SHUT_WR)
                self._over.wait()


def _unread(sock: socket.socket) -> int:
    """Return the number of bytes that were sent to the client, but that the client has not yet read."""
    (count,) = struct.unpack("i", fcntl.ioctl(sock, termios.TIOCOUTQ, bytes(4)))
    return int(count)
