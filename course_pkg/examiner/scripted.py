"""A server for the student's client, which does exactly what a check tells it to, misbehaviour included.

It speaks TCPROS itself (wiki.ros.org/ROS/TCPROS, "Service Client" and "Service"): rospy's own
server cannot be made to hang up, to keep silent or to be of another definition.
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

from course_pkg.examiner.node import Node, Registration
from course_pkg.examiner.plain import Plain, ServiceClass, plain


@dataclass(frozen=True)
class Refuse:
    """Answer with an error, worded as rospy words a ServiceException that a handler raises."""

    reason: str


@dataclass(frozen=True)
class HangUp:
    """Close the connection without an answer, as a server that dies does."""


@dataclass(frozen=True)
class Silence:
    """Take the request and never answer."""


@dataclass(frozen=True)
class Late:
    """Answer with `values` after `delay` s."""

    delay: float
    values: Mapping[str, Plain]


Act = Mapping[str, Plain] | genpy.Message | Refuse | HangUp | Silence | Late
Script = Callable[..., Act]  # of the request


@dataclass
class Seen:
    """What a scripted server saw; requests as plain data, in the order of their arrival."""

    requests: list[dict[str, Plain]] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)  # of the calls, probes left out
    probes: int = 0  # connections that only asked whether somebody is there, as wait_for_service does


class ScriptedServer:
    """Serves `name` while the block lasts, and gives the name back to who served it before."""

    def __init__(self, node: Node, name: str, kind: ServiceClass, script: Script) -> None:
        self.seen = Seen()
        self.problem: Exception | None = None
        self._node, self._name, self._kind, self._script = node, name, kind, script
        self._over = threading.Event()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._uri = f"rosrpc://localhost:{self._listener.getsockname()[1]}"
        self._former: Registration | None = None
        self._connections: set[socket.socket] = set()

    @property
    def requests(self) -> list[dict[str, Plain]]:
        """The requests so far, as plain data."""
        return list(self.seen.requests)

    def __enter__(self) -> ScriptedServer:
        self._former = self._node.registration(self._name)
        threading.Thread(target=self._accept, daemon=True).start()
        _register(self._node, self._name, self._uri)
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.leave()
        if self.problem and error is None:
            raise self.problem

    def leave(self) -> None:
        """Stop serving, as a server that is shut down does; connections are closed."""
        self._over.set()
        self._close_port()
        for connection in self._connections.copy():
            with suppress(OSError):  # closed by itself meanwhile
                connection.shutdown(socket.SHUT_RDWR)
        self._node.master.unregister_service(self._node.name, self._name, self._uri)
        _restore(self._node, self._name, self._former)
        self._former = None

    def _close_port(self) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):  # the listener was closed: over
            while True:
                sock, _ = self._listener.accept()
                threading.Thread(target=self._attend, args=(sock,), daemon=True).start()

    def _attend(self, sock: socket.socket) -> None:
        """Serve one connection until the client, the script or leave() closes it."""
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
            self.seen.headers.append(dict(header))
            while self._serve_one(sock) and header.get("persistent") in ("1", "true"):
                pass

    def _greet(self, sock: socket.socket, header: Mapping[str, str]) -> bool:
        """Answer the handshake; return whether a request follows."""
        md5, theirs = self._kind._md5sum, header.get("md5sum")
        if theirs not in (md5, "*"):
            words = f"request from [{header.get('callerid')}]: md5sums do not match: [{theirs}] vs. [{md5}]"
            write_ros_handshake_header(sock, {"error": words})
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
        self.seen.probes += (probe := header.get("probe") == "1")
        return not probe

    def _serve_one(self, sock: socket.socket) -> bool:
        """Read one request and do what the script says; return whether the connection goes on."""
        request = self._kind._request_class()
        request.deserialize(_exactly(sock, struct.unpack("<I", _exactly(sock, 4))[0]))
        self.seen.requests.append(plain(request))
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
            words = f"service cannot process request: {act.reason}".encode()
            sock.sendall(b"\x00" + struct.pack("<I", len(words)) + words)
            return True
        response = act if isinstance(act, genpy.Message) else self._kind._response_class(**act)
        body = io.BytesIO()
        response.serialize(body)
        sock.sendall(b"\x01" + struct.pack("<I", len(body.getvalue())) + body.getvalue())
        return True


class Absent:
    """Nobody serves `name` while the block lasts; `stale` leaves a dead entry, as a kill does."""

    def __init__(self, node: Node, name: str, *, stale: bool = False) -> None:
        self._node, self._name, self._stale = node, name, stale
        self._former: Registration | None = None
        self._uri = ""

    def __enter__(self) -> Absent:
        self._former = self._node.registration(self._name)
        if self._former:
            self._node.master.unregister_service(self._former.node, self._name, self._former.uri)
        if self._stale:
            self._uri = f"rosrpc://localhost:{closed_port()}"
            _register(self._node, self._name, self._uri)
        return self

    def __exit__(self, *_: object) -> None:
        if self._uri:
            self._node.master.unregister_service(self._node.name, self._name, self._uri)
        _restore(self._node, self._name, self._former)


def _register(node: Node, name: str, uri: str) -> None:
    node.master.register_service(node.name, name, uri, node.uri)


def _restore(node: Node, name: str, former: Registration | None) -> None:
    """Register for `name` again, in its own name, the node that was registered before.

    The master knows one provider a name and forgets the one before, who never hears of it.
    """
    if former:
        node.master.register_service(former.node, name, former.uri, former.node_uri)


def closed_port() -> int:
    """Return a port of this computer at which nobody listens."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port: int = listener.getsockname()[1]
        return port


def _exactly(sock: socket.socket, count: int) -> bytes:
    data = b""
    while len(data) < count:
        if not (chunk := sock.recv(count - len(data))):
            raise ConnectionResetError("the client hung up")
        data += chunk
    return data
