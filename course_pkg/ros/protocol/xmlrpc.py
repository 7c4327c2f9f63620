"""XML-RPC in bounded time, for the master and for nodes; nothing but the standard library.

ROS's APIs answer each call with [code, message, value]: http://wiki.ros.org/ROS/Master_Slave_APIs.
"""

from __future__ import annotations

import os
import socket
import time
import weakref
from collections import deque
from http.client import HTTPConnection, HTTPException
from typing import TYPE_CHECKING, Union
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, dumps, loads

from course_pkg.errors import MalformedMasterUri

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer, WriteableBuffer

RpcValue = Union[bool, int, float, str, bytes, None, "list[RpcValue]", "dict[str, RpcValue]"]

STALE = (ConnectionResetError, ConnectionAbortedError, BrokenPipeError, HTTPException)  # of a kept connection
NO_ANSWER = (HTTPException, ExpatError, Fault, LookupError, TypeError, ValueError)  # bytes, but not XML-RPC


class XmlRpcClient:
    """Calls the methods of one XML-RPC server at `uri`, each in at most `timeout` s. Threads may share it.

    Raises MalformedMasterUri.
    """

    def __init__(self, uri: str, timeout: float = 2.0) -> None:
        self.uri = uri
        self.timeout = timeout
        self.address = address_of(uri)
        self._idle: deque[_Connection] = deque()
        weakref.finalize(self, _close, self._idle)

    def ask(self, method: str, *args: RpcValue, timeout: float | None = None) -> RpcValue:
        """Return what `method` answers within `timeout` s, or the client's own timeout if that is shorter.

        Raises TimeoutError, another OSError where no program accepts the connection, and one of NO_ANSWER
        where the answer is not XML-RPC, or is a fault.
        """
        deadline = time.monotonic() + self.limit(timeout)
        return decode(self._exchange(encode(method, *args), deadline))

    def limit(self, timeout: float | None) -> float:
        """Return for how many s a call with this timeout may take."""
        return self.timeout if timeout is None else min(timeout, self.timeout)

    def close(self) -> None:
        """Close the connections that were kept for the next call."""
        _close(self._idle)

    def _exchange(self, body: bytes, deadline: float) -> bytes:
        """Send a request over a kept connection, or over a new one when none is left that still works."""
        while self._idle:
            connection = self._idle.pop()
            if connection.pid != os.getpid():
                continue  # inherited by a fork: the parent is using it
            try:
                return self._over(connection, body, deadline)
            except STALE:
                continue
        return self._over(_Connection(self.address), body, deadline)

    def _over(self, connection: _Connection, body: bytes, deadline: float) -> bytes:
        answer = None
        try:
            answer = connection.exchange(body, deadline)
        finally:
            if answer is None:
                connection.close()
        self._idle.append(connection)
        return answer


def encode(method: str, *args: RpcValue) -> bytes:
    """Return the body of a request."""
    return dumps(args, method).encode()


def decode(body: bytes) -> RpcValue:
    """Return the value in the body of an answer. Raises one of NO_ANSWER."""
    value: RpcValue = loads(body)[0][0]  # type: ignore[assignment]  # typeshed knows its values, too, as a union
    return value


def items(value: RpcValue) -> list[RpcValue]:
    """Return `value` as the list that it is. Raises TypeError for anything else."""
    if not isinstance(value, list):
        raise TypeError(f"a list was expected, not {type(value).__name__}")
    return value


def number(value: RpcValue) -> float:
    """Return `value` as the number that it is. Raises TypeError for anything else."""
    if not isinstance(value, (int, float)):
        raise TypeError(f"a number was expected, not {type(value).__name__}")
    return value


def address_of(uri: str) -> tuple[str, int]:
    """Return host and port of a master's URI. Raises MalformedMasterUri."""
    try:
        parts = urlsplit(uri)
        if parts.scheme == "http" and parts.hostname and parts.port:
            return parts.hostname, parts.port
    except ValueError:
        pass  # a port that is no number, or a bracket that is not closed
    raise MalformedMasterUri(
        f"ROS_MASTER_URI is {uri!r}, and has to be of the form http://HOST:PORT, such as "
        "http://localhost:11311. Correct it, or unset it to have a master of your own."
    )


def port_of(uri: str) -> int:
    """Return the port of http://HOST:PORT/ or rosrpc://HOST:PORT, or 0 where there is none."""
    digits = uri.rstrip("/").rpartition(":")[2]
    return int(digits) if digits.isdigit() else 0


def _close(connections: deque[_Connection]) -> None:
    while connections:
        connections.pop().close()


class _Connection(HTTPConnection):
    """An HTTP connection with one deadline for a whole exchange, even if each byte comes in time."""

    sock: _DeadlineSocket | None

    def __init__(self, address: tuple[str, int]) -> None:
        super().__init__(*address)
        self.pid = os.getpid()
        self._deadline = 0.0

    def connect(self) -> None:
        """Connect before the deadline."""
        limit = max(self._deadline - time.monotonic(), 0.001)
        plain = socket.create_connection((self.host, self.port), limit)
        plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.sock = _DeadlineSocket(fileno=plain.detach())

    def exchange(self, body: bytes, deadline: float) -> bytes:
        """Send a request and return the body of the answer."""
        self._deadline = deadline
        if self.sock is None:
            self.connect()
        assert self.sock is not None
        self.sock.deadline = deadline
        self.request("POST", "/RPC2", body, {"Content-Type": "text/xml"})
        response = self.getresponse()
        answer = response.read()
        if response.status != 200:
            raise HTTPException(f"{response.status} {response.reason}")
        return answer


class _DeadlineSocket(socket.socket):
    """A socket whose every operation ends at `deadline`, a time of time.monotonic()."""

    deadline = 0.0

    def recv_into(self, buffer: WriteableBuffer, nbytes: int = 0, flags: int = 0) -> int:
        """Receive before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        return super().recv_into(buffer, nbytes, flags)

    def sendall(self, data: ReadableBuffer, flags: int = 0) -> None:
        """Send before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        super().sendall(data, flags)
