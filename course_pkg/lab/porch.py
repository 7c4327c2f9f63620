"""Who comes while the server is still starting: one page is handed out at once, all others wait inside.

A browser is busy with JupyterLab's page for a second before it asks for anything else, and in that time the
server can finish its start. This module is there before it, and so imports nothing but what Python has.
"""

from __future__ import annotations

import hmac
import selectors
import socket
import threading
from contextlib import suppress
from typing import Any

PATIENCE = 1.0  # s for a browser to say the rest of its question, and to take the answer
HEAD = 65536  # bytes of a question that are read


class Porch:
    """Accepts connections at `listener` until clear() is called.

    A connection that begins with `question` gets `answer`, a whole response of HTTP, and is closed. What
    others say stays in their sockets, for the server to read. An empty `answer` is given to nobody.
    """

    def __init__(self, listener: socket.socket, question: bytes, answer: bytes) -> None:
        self.listener = listener
        self._question, self._answer = question, answer
        self._waiting: dict[socket.socket, Any] = {}
        self._wake, self._waker = socket.socketpair()
        self._thread = threading.Thread(target=self._keep, name="porch", daemon=True)
        listener.setblocking(False)
        self._thread.start()

    def clear(self) -> list[tuple[socket.socket, Any]]:
        """Accept no more; return the connections that wait, each with the address that it comes from."""
        self._waker.close()
        self._thread.join()
        self._wake.close()
        return list(self._waiting.items())

    def _keep(self) -> None:
        with selectors.DefaultSelector() as selector:
            selector.register(self._wake, selectors.EVENT_READ)
            selector.register(self.listener, selectors.EVENT_READ)
            while True:
                for key, _ in selector.select():
                    if key.fileobj is self._wake:
                        return
                    if key.fileobj is self.listener:
                        self._accept(selector)
                    else:
                        selector.unregister(key.fileobj)
                        self._hear(key.fileobj)  # type: ignore[arg-type]  # a socket of _accept's

    def _accept(self, selector: selectors.BaseSelector) -> None:
        with suppress(BlockingIOError, ConnectionError):  # it has gone again
            connection, address = self.listener.accept()
            connection.setblocking(False)
            self._waiting[connection] = address
            selector.register(connection, selectors.EVENT_READ)

    def _hear(self, connection: socket.socket) -> None:
        with suppress(OSError):
            begin = connection.recv(len(self._question), socket.MSG_PEEK)
            if self._answer and hmac.compare_digest(begin, self._question):
                del self._waiting[connection]
                self._hand_out(connection)

    def _hand_out(self, connection: socket.socket) -> None:
        with connection, suppress(OSError):
            connection.settimeout(PATIENCE)
            head = b""
            while (
                b"\r\n\r\n" not in head and len(head) < HEAD
            ):  # what is left unread would break the answer off
                if not (more := connection.recv(HEAD)):
                    return
                head += more
            connection.sendall(self._answer)
