"""One JSON object a line over a stream socket, both ways."""

from __future__ import annotations

import json
import select
import socket
import threading
from collections.abc import Mapping
from contextlib import suppress
from typing import Any


class Wire:
    """One end; a thread may send while another receives. Raises EOFError when the other end is gone."""

    def __init__(self, sock: socket.socket) -> None:
        self._socket = sock
        self._received = bytearray()
        self._turn = threading.Lock()

    def send(self, message: Mapping[str, Any]) -> None:
        """Send a message, waiting for as long as the other end does not read."""
        line = json.dumps(message).encode() + b"\n"
        try:
            with self._turn:
                self._socket.sendall(line)
        except OSError as error:
            raise EOFError(str(error)) from error

    def receive(self, timeout: float | None = None) -> dict[str, Any] | None:
        """Return the next message, or None when there is none within `timeout` s."""
        while b"\n" not in self._received:
            try:
                if not select.select([self._socket], [], [], timeout)[0]:
                    return None
                part = self._socket.recv(65536)
            except (OSError, ValueError) as error:  # a ValueError for a socket that was closed here
                raise EOFError(str(error)) from error
            if not part:
                raise EOFError("the other end closed the wire")
            self._received += part
        line, _, rest = self._received.partition(b"\n")
        self._received = bytearray(rest)
        message: dict[str, Any] = json.loads(line)
        return message

    def close(self) -> None:
        """Close this end; the other one notices, and so does a thread that receives here."""
        with suppress(OSError):  # the other end was faster
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
