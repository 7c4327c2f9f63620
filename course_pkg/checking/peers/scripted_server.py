"""A server for the student's client; a script in the check chooses each response.

The server implements TCPROS itself (wiki.ros.org/ROS/TCPROS, "Service Client" and "Service"). A server of
rospy cannot close a connection without a response, ignore a request, or use a changed service definition.
"""

from __future__ import annotations

import io
import socket
import struct
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

import genpy
from rosgraph.network import ROSHandshakeException, read_ros_handshake_header, write_ros_handshake_header

from course_pkg.checking.peers.node import Node, Registration, closed_port
from course_pkg.checking.plain_values import Fields, ServiceClass, Value, fields_of


@dataclass(frozen=True)
class Refuse:
    """Send the error message that rospy sends after a ServiceException in a handler."""

    reason: str


@dataclass(frozen=True)
class HangUp:
    """Close the connection without a response, as a crashed server does."""


@dataclass(frozen=True)
class Silence:
    """Read the request, but never respond."""


@dataclass(frozen=True)
class Late:
    """Wait for the time `delay` (s), and then respond with the values `values`, or refuse the request."""

    delay: float
    values: Mapping[str, Value] | Refuse


Act = Mapping[str, Value] | genpy.Message | Refuse | HangUp | Silence | Late
Script = Callable[..., Act]  # A script is a function that returns the server's action for a request.


@dataclass
class Received:
    """The requests to a scripted server as plain data, in the order of their arrival."""

    requests: list[Fields] = field(default_factory=list)
    # The connection headers of all calls; the headers of probes are not stored.
    headers: list[dict[str, str]] = field(default_factory=list)
    # This is the number of connections without a request, such as the connections of wait_for_service.
    probes: int = 0


class ScriptedServer:
    """Offers the service during the `with` block, and then registers the previous server again."""

    def __init__(self, node: Node, name: str, kind: ServiceClass, script: Script) -> None:
        self.received = Received()
        self.problem: Exception | None = None
        self._node, self._name, self._kind, self._script = node, name, kind, script
        self._over = threading.Event()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._uri = f"rosrpc://localhost:{self._listener.getsockname()[1]}"
        self._former: Registration | None = None
        self._connections: set[socket.socket] = set()

    @property
    def requests(self) -> list[Fields]:
        """The requests that have arrived, as plain data."""
        return list(self.received.requests)

    @property
    def uri(self) -> str:
        """The registered address of the service."""
        return self._uri

    def __enter__(self) -> ScriptedServer:
        self._former = self._node.registration(self._name)
        threading.Thread(target=self._accept, daemon=True).start()
        self._node.register(self._name, self._uri)
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.leave()
        if self.problem and error is None:
            raise self.problem

    def leave(self) -> None:
        """Stop serving and close all connections, like a server that shuts down."""
        self._over.set()
        self._close_port()
        for connection in self._connections.copy():
            with suppress(OSError):  # The socket is closed already.
                connection.shutdown(socket.SHUT_RDWR)
        self._node.master.unregister_service(self._node.name, self._name, self._uri)
        self._node.restore(self._name, self._former)
        self._former = None

    def _close_port(self) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):  # leave() has closed the listening socket.
            while True:
                sock, _ = self._listener.accept()
                threading.Thread(target=self._serve_connection, args=(sock,), daemon=True).start()

    def _serve_connection(self, sock: socket.socket) -> None:
        """Serve one connection until the connection is closed.

        The client, an action of the script, or leave() can close the connection.
        """
        self._connections.add(sock)
        try:
            self._serve(sock)
        finally:
            self._connections.discard(sock)

    def _serve(self, sock: socket.socket) -> None:
        with sock, suppress(OSError, ROSHandshakeException):
            header = read_ros_handshake_header(sock, io.BytesIO(), 4096)
            if not self._greet(sock, header):
                return
            self.received.headers.append(dict(header))
            while self._serve_one(sock) and header.get("persistent") in ("1", "true"):
                pass

    def _greet(self, sock: socket.socket, header: Mapping[str, str]) -> bool:
        """Reply to the handshake; return whether a request follows."""
        md5, theirs = self._kind._md5sum, header.get("md5sum")
        if theirs not in (md5, "*"):
            problem = f"request from [{header.get('callerid')}]: md5sums do not match: [{theirs}] vs. [{md5}]"
            write_ros_handshake_header(sock, {"error": problem})
            return False
        answer = {
            "callerid": self._node.name,
            "md5sum": md5,
            "type": self._kind._type,
            "service": self._name,
        }
        answer["request_type"] = self._kind._request_class._type
        answer["response_type"] = self._kind._response_class._type
        write_ros_handshake_header(sock, answer)
        self.received.probes += (probe := header.get("probe") == "1")
        return not probe

    def _serve_one(self, sock: socket.socket) -> bool:
        """Read one request and execute the script's action; return whether the connection is still open."""
        request = self._kind._request_class()
        request.deserialize(_exactly(sock, struct.unpack("<I", _exactly(sock, 4))[0]))
        self.received.requests.append(fields_of(request))
        try:
            return self._act(sock, self._script(request))
        except (TypeError, ValueError, LookupError, AttributeError, genpy.SerializationError) as error:
            self.problem = error
            return False

    def _act(self, sock: socket.socket, act: Act) -> bool:
        if isinstance(act, Late):
            self._over.wait(act.delay)
            return self._act(sock, act.values)
        if isinstance(act, Silence):
            self._over.wait()
        if isinstance(act, (Silence, HangUp)):
            return False
        if isinstance(act, Refuse):
            send_error(sock, f"service cannot process request: {act.reason}")
            return True
        response = act if isinstance(act, genpy.Message) else self._kind._response_class(**act)
        body = io.BytesIO()
        response.serialize(body)
        sock.sendall(b"\x01" + struct.pack("<I", len(body.getvalue())) + body.getvalue())
        return True


class Absent:
    """Unregisters the server of the service `name` during the `with` block.

    If `stale` is true, the address of a closed port of `host` is registered for the service.
    """

    def __init__(self, node: Node, name: str, *, stale: bool = False, host: str = "localhost") -> None:
        self._node, self._name, self._stale, self._host = node, name, stale, host
        self._former: Registration | None = None
        self._uri = ""

    @property
    def uri(self) -> str:
        """The address with a closed port, or "" if no address is registered."""
        return self._uri

    def __enter__(self) -> Absent:
        self._former = self._node.registration(self._name)
        if self._former:
            self._node.master.unregister_service(self._former.node, self._name, self._former.uri)
        if self._stale:
            self._uri = f"rosrpc://{self._host}:{closed_port()}"
            self._node.register(self._name, self._uri)
        return self

    def __exit__(self, *_: object) -> None:
        if self._uri:
            self._node.master.unregister_service(self._node.name, self._name, self._uri)
        self._node.restore(self._name, self._former)


def send_error(sock: socket.socket, text: str) -> None:
    """Respond with an error: a byte 0, the length as uint32, and the text (TCPROS, "Service")."""
    sock.sendall(b"\x00" + struct.pack("<I", len(text.encode())) + text.encode())


def _exactly(sock: socket.socket, count: int) -> bytes:
    data = b""
    while len(data) < count:
        if not (chunk := sock.recv(count - len(data))):
            raise ConnectionResetError("the client closed the connection")
        data += chunk
    return data
