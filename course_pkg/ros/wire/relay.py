"""A relay that forwards TCP connections and stores their bytes, to show the bytes of a real call.

The relay is between a client and a server. The relay does not change or interpret the bytes.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType

# At most this number of bytes is stored for each direction of a connection. Further bytes are only forwarded
# and counted.
MOST = 4 << 20
# At most this number of connections is stored. Further connections are only forwarded and counted.
CONNECTIONS = 50
CONNECT_TIMEOUT = 5.0  # A connection to the server has to be open within this time in s.
CLOSE_TIMEOUT = 2.0  # Wait up to this time in s for the end of open connections.
CHUNK = 65536  # At most this number of bytes is forwarded at a time.


@dataclass(frozen=True)
class Chunk:
    """Bytes that arrived together from the client or the server; `at` is a value of time.monotonic()."""

    at: float
    from_client: bool
    data: bytes


@dataclass
class RelayedConnection:
    """One connection and its bytes, in the order of their arrival."""

    opened: float  # The connection was opened at this value of time.monotonic().
    chunks: list[Chunk] = field(default_factory=list)
    # The side that closed the connection first ("client" or "server"), or "" while the connection is open.
    closed_by: str = ""
    refused: str = ""  # This is the error message if the server could not be reached.
    lost: int = 0  # This number of bytes was forwarded but not stored.

    def data(self, *, from_client: bool) -> bytes:
        """Return all stored bytes of one direction."""
        return b"".join(chunk.data for chunk in self.chunks if chunk.from_client is from_client)

    def since(self, offset: int, *, from_client: bool) -> float:
        """Return the time in s from the opening of the connection to the arrival of a byte.

        `offset` is the index of the byte in the data of one direction, from 0.
        """
        count = 0
        for chunk in self.chunks:
            if chunk.from_client is from_client:
                count += len(chunk.data)
                if count > offset:
                    return chunk.at - self.opened
        return (self.chunks[-1].at - self.opened) if self.chunks else 0.0


class Relay:
    """Listens on a new `port` and forwards each connection to the target, until close() is called."""

    def __init__(self, host: str, port: int) -> None:
        self.target = (host, port)
        self.skipped = 0  # This number of connections was forwarded but not stored.
        self._connections: list[RelayedConnection] = []
        self._open: set[socket.socket] = set()
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._closed = False
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self._start(self._accept)

    @property
    def connections(self) -> Sequence[RelayedConnection]:
        """The connections so far, in the order of their start."""
        return tuple(self._connections)

    def wait(self, timeout: float = CLOSE_TIMEOUT) -> None:
        """Wait until the open connections have ended, for at most `timeout` s."""
        deadline = time.monotonic() + timeout
        for thread in self._threads[1:]:
            thread.join(max(deadline - time.monotonic(), 0))

    def close(self) -> None:
        """Close the port and every connection; a second call has no effect."""
        with self._lock:
            self._closed = True
            for sock in [self._listener, *self._open]:
                with suppress(OSError):  # The socket may be closed.
                    sock.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        deadline = time.monotonic() + CLOSE_TIMEOUT
        for thread in self._threads:
            thread.join(max(deadline - time.monotonic(), 0))

    def __enter__(self) -> Relay:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _start(self, work: Callable[..., None], *args: object) -> None:
        thread = threading.Thread(target=work, args=args, daemon=True)
        self._threads = [each for each in self._threads if each.is_alive() or each.ident is None]
        self._threads.append(thread)
        thread.start()

    def _accept(self) -> None:
        with suppress(OSError):  # The listener was closed.
            while True:
                client, _ = self._listener.accept()
                connection = RelayedConnection(time.monotonic())
                if len(self._connections) < CONNECTIONS:
                    self._connections.append(connection)
                else:
                    self.skipped += 1
                self._start(self._forward, client, connection)

    def _forward(self, client: socket.socket, connection: RelayedConnection) -> None:
        with client:
            try:
                server = socket.create_connection(self.target, CONNECT_TIMEOUT)
            except OSError as error:
                connection.refused = error.strerror or str(error)
                return
            with server:
                server.settimeout(None)
                for sock in (client, server):
                    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                if self._remember(client, server):
                    self._forward_both(client, server, connection)

    def _remember(self, *socks: socket.socket) -> bool:
        """Store sockets for close(); return False if close() was already called."""
        with self._lock:
            if not self._closed:
                self._open.update(socks)
            return not self._closed

    def _forward_both(
        self, client: socket.socket, server: socket.socket, connection: RelayedConnection
    ) -> None:
        back = threading.Thread(target=_copy, args=(server, client, False, connection), daemon=True)
        back.start()
        try:
            _copy(client, server, True, connection)
            back.join()
        finally:
            with self._lock:
                self._open -= {client, server}


def _copy(
    source: socket.socket, sink: socket.socket, from_client: bool, connection: RelayedConnection
) -> None:
    """Forward the bytes from `source` to `sink`, and then close `sink` for writing."""
    kept = 0
    # It is no error if the connection was reset or if close() ended it.
    with suppress(OSError):
        while data := source.recv(CHUNK):
            kept += len(data)
            if kept <= MOST:
                connection.chunks.append(Chunk(time.monotonic(), from_client, data))
            else:
                connection.lost += len(data)
            sink.sendall(data)
    connection.closed_by = connection.closed_by or ("client" if from_client else "server")
    with suppress(OSError):
        sink.shutdown(socket.SHUT_WR)
