"""A TCP connection passed on byte for byte, and what passed kept: how the bytes of a real call are seen.

It stands between two programs that speak whatever they speak, changes nothing, and knows no protocol.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType

MOST = 4 << 20  # bytes that are kept of each direction of a connection; what is more is passed on and counted
CONVERSATIONS = 50  # that are kept; more are passed on and counted
PATIENCE = 5.0  # s to reach the other end
ENDING = 2.0  # s for what is under way to end
PIECE = 65536  # bytes that are passed on at once


@dataclass(frozen=True)
class Chunk:
    """Bytes that came at once, at a time of time.monotonic(), from the client or from the server."""

    at: float
    from_client: bool
    data: bytes


@dataclass
class Conversation:
    """One connection: all that was said on it, in the order in which it came by."""

    opened: float  # a time of time.monotonic()
    chunks: list[Chunk] = field(default_factory=list)
    closed_by: str = ""  # "client" or "server", whoever was first; empty while it is open
    refused: str = ""  # why the other end could not be reached
    lost: int = 0  # bytes that were passed on and not kept

    def said(self, *, by_client: bool) -> bytes:
        """Return all bytes of one direction that were kept."""
        return b"".join(chunk.data for chunk in self.chunks if chunk.from_client is by_client)

    def since(self, offset: int, *, by_client: bool) -> float:
        """Return when the byte at `offset` of one direction came by, in s since the connection was opened."""
        passed = 0
        for chunk in self.chunks:
            if chunk.from_client is by_client:
                passed += len(chunk.data)
                if passed > offset:
                    return chunk.at - self.opened
        return (self.chunks[-1].at - self.opened) if self.chunks else 0.0


class Relay:
    """Listens on a `port` of its own and passes each connection on to the target, until it is closed."""

    def __init__(self, host: str, port: int) -> None:
        self.target = (host, port)
        self.missed = 0  # connections that were passed on and not kept
        self._conversations: list[Conversation] = []
        self._open: set[socket.socket] = set()
        self._threads: list[threading.Thread] = []
        self._lock = threading.Lock()
        self._closed = False
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self._begin(self._accept)

    @property
    def conversations(self) -> Sequence[Conversation]:
        """What was kept so far, in the order in which the connections were opened."""
        return tuple(self._conversations)

    def settle(self, patience: float = ENDING) -> None:
        """Wait until the connections that there are have ended by themselves, at most `patience` s."""
        deadline = time.monotonic() + patience
        for thread in self._threads[1:]:
            thread.join(max(deadline - time.monotonic(), 0))

    def close(self) -> None:
        """Close the port and every connection; a second close changes nothing."""
        with self._lock:
            self._closed = True
            for sock in [self._listener, *self._open]:
                with suppress(OSError):  # gone already
                    sock.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        deadline = time.monotonic() + ENDING
        for thread in self._threads:
            thread.join(max(deadline - time.monotonic(), 0))

    def __enter__(self) -> Relay:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _begin(self, work: Callable[..., None], *args: object) -> None:
        thread = threading.Thread(target=work, args=args, daemon=True)
        self._threads = [each for each in self._threads if each.is_alive() or each.ident is None]
        self._threads.append(thread)
        thread.start()

    def _accept(self) -> None:
        with suppress(OSError):  # the listener was closed: over
            while True:
                client, _ = self._listener.accept()
                conversation = Conversation(time.monotonic())
                if len(self._conversations) < CONVERSATIONS:
                    self._conversations.append(conversation)
                else:
                    self.missed += 1
                self._begin(self._carry, client, conversation)

    def _carry(self, client: socket.socket, conversation: Conversation) -> None:
        with client:
            try:
                server = socket.create_connection(self.target, PATIENCE)
            except OSError as error:
                conversation.refused = error.strerror or str(error)
                return
            with server:
                server.settimeout(None)
                for sock in (client, server):
                    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                if self._held(client, server):
                    self._both_ways(client, server, conversation)

    def _held(self, *socks: socket.socket) -> bool:
        with self._lock:
            if not self._closed:
                self._open.update(socks)
            return not self._closed

    def _both_ways(self, client: socket.socket, server: socket.socket, conversation: Conversation) -> None:
        back = threading.Thread(target=_pass, args=(server, client, False, conversation), daemon=True)
        back.start()
        try:
            _pass(client, server, True, conversation)
            back.join()
        finally:
            with self._lock:
                self._open -= {client, server}


def _pass(source: socket.socket, sink: socket.socket, from_client: bool, conversation: Conversation) -> None:
    """Pass on what comes from one side, its end included."""
    kept = 0
    with suppress(OSError):  # reset, or closed from here: an end like any other
        while data := source.recv(PIECE):
            kept += len(data)
            if kept <= MOST:
                conversation.chunks.append(Chunk(time.monotonic(), from_client, data))
            else:
                conversation.lost += len(data)
            sink.sendall(data)
    conversation.closed_by = conversation.closed_by or ("client" if from_client else "server")
    with suppress(OSError):
        sink.shutdown(socket.SHUT_WR)
