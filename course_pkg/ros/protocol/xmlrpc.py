"""XML-RPC with time limits, for the master and for nodes; uses only the standard library.

The methods of ROS's APIs return [code, message, value]: http://wiki.ros.org/ROS/Master_Slave_APIs.
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

# One of these errors means that the server has closed an idle connection.
STALE = (ConnectionResetError, ConnectionAbortedError, BrokenPipeError, HTTPException)
# ask() raises one of these errors if a response is not valid XML-RPC, or is a fault.
NO_ANSWER = (HTTPException, ExpatError, Fault, LookupError, TypeError, ValueError)


class XmlRpcClient:
    """Calls the methods of the XML-RPC server at the address `uri`; each call takes at most `timeout` s.

    Several threads may use one client. The constructor raises MalformedMasterUri if `uri` is invalid.
    """

    def __init__(self, uri: str, timeout: float = 2.0) -> None:
        self.uri = uri
        self.timeout = timeout
        self.address = address_of(uri)
        self._idle: deque[_Connection] = deque()
        weakref.finalize(self, _close, self._idle)

    def ask(self, method: str, *args: RpcValue, timeout: float | None = None) -> RpcValue:
        """Call the method `method`, and return the value in its response.

        The time limit is the shorter of `timeout` (s) and the client's own timeout. Raises TimeoutError at
        the time limit, and another OSError if no program accepts the connection. Raises one of the errors in
        NO_ANSWER if the response is not valid XML-RPC or is a fault.
        """
        deadline = time.monotonic() + self.limit(timeout)
        return decode(self._exchange(encode(method, *args), deadline))

    def limit(self, timeout: float | None) -> float:
        """Return the time limit in s of a call with this timeout."""
        return self.timeout if timeout is None else min(timeout, self.timeout)

    def close(self) -> None:
        """Close the idle connections."""
        _close(self._idle)

    def _exchange(self, body: bytes, deadline: float) -> bytes:
        """Send a request on an idle connection, or on a new connection if no idle connection works."""
        while self._idle:
            connection = self._idle.pop()
            if connection.pid != os.getpid():
                continue  # This process is a fork. The parent process uses this connection.
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
    """Return the value in a response's body; raises one of the errors in NO_ANSWER if the body is invalid."""
    value: RpcValue = loads(body)[0][0]  # type: ignore[assignment]  # typeshed has another union of types
    return value


def items(value: RpcValue) -> list[RpcValue]:
    """Return the value if it is a list; raises TypeError otherwise."""
    if not isinstance(value, list):
        raise TypeError(f"a list was expected, not {type(value).__name__}")
    return value


def number(value: RpcValue) -> float:
    """Return the value if it is a number; raises TypeError otherwise."""
    if not isinstance(value, (int, float)):
        raise TypeError(f"a number was expected, not {type(value).__name__}")
    return value


def address_of(uri: str) -> tuple[str, int]:
    """Return the host and port of a master's URI; raises MalformedMasterUri if the URI is invalid."""
    try:
        parts = urlsplit(uri)
        if parts.scheme == "http" and parts.hostname and parts.port:
            return parts.hostname, parts.port
    except ValueError:
        pass  # The port is not a number, or a closing bracket is missing.
    raise MalformedMasterUri(
        f"ROS_MASTER_URI is {uri!r}, but has to be of the form http://HOST:PORT, such as "
        "http://localhost:11311. Correct ROS_MASTER_URI, or unset this variable to get your "
        "own master."
    )


def port_of(uri: str) -> int:
    """Return the port of http://HOST:PORT/ or rosrpc://HOST:PORT, or 0 if the address has no port."""
    digits = uri.rstrip("/").rpartition(":")[2]
    return int(digits) if digits.isdigit() else 0


def _close(connections: deque[_Connection]) -> None:
    while connections:
        connections.pop().close()


class _Connection(HTTPConnection):
    """An HTTP connection with one deadline for a request and its complete response."""

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
        """Send a request and return the body of the response; raises TimeoutError at the deadline."""
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
    """A socket with one deadline for all operations; `deadline` is a value of time.monotonic()."""

    deadline = 0.0

    def recv_into(self, buffer: WriteableBuffer, nbytes: int = 0, flags: int = 0) -> int:
        """Receive before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        return super().recv_into(buffer, nbytes, flags)

    def sendall(self, data: ReadableBuffer, flags: int = 0) -> None:
        """Send before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        super().sendall(data, flags)
