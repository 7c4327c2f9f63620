"""Send requests to many addresses at the same time, on one thread, with a time limit."""

from __future__ import annotations

import selectors
import socket
import struct
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum

from rosgraph.network import (
    ROSHandshakeException,
    decode_ros_handshake_header,
    encode_ros_handshake_header,
)

from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, RpcValue, decode, encode, items, port_of

END = b"</methodResponse>"  # An XML-RPC response ends with these bytes.
HTTP_HEAD = "POST /RPC2 HTTP/1.0\r\nContent-Type: text/xml\r\nContent-Length: {}\r\n\r\n"


class Reach(Enum):
    """The result of a probe."""

    ANSWERED = "answered"
    REFUSED = "refused"  # No process listens at the address, so the node has ended.
    SILENT = "silent"  # A process listens but does not respond, because it is suspended or busy.
    # The host cannot be reached, or the connection closed before the response was complete.
    LOST = "lost"


@dataclass
class Probe:
    """One request to one address; `complete` returns whether the received bytes are a complete response."""

    address: tuple[str, int]
    request: bytes
    complete: Callable[[bytes], bool]
    answer: bytes = b""
    reach: Reach = field(default=Reach.SILENT)

    @property
    def answered(self) -> bool:
        """Whether a complete response was received."""
        return self.reach is Reach.ANSWERED


def ask_all(probes: Sequence[Probe], timeout: float) -> None:
    """Set `answer` and `reach` of each probe; return when all probes have a result, or after `timeout` s."""
    deadline = time.monotonic() + timeout
    resolved = {host: _resolved(host) for host in {probe.address[0] for probe in probes}}
    with selectors.DefaultSelector() as selector:
        for probe in probes:
            _begin(probe, resolved[probe.address[0]], selector)
        try:
            while selector.get_map() and (rest := deadline - time.monotonic()) > 0:
                for key, _ in selector.select(rest):
                    _go_on(key, selector)
        finally:
            for key in list(selector.get_map().values()):
                _end(key, selector)


def service_probe(name: str, uri: str) -> Probe:
    """Return a probe that requests a service's type from its server, as rospy.wait_for_service() does."""
    header = {"probe": "1", "md5sum": "*", "callerid": "/course", "service": name}
    return Probe(_address(uri), encode_header(header), _whole_header)


def node_probe(uri: str) -> Probe:
    """Return a probe that calls getPid of the slave API, to check whether a node answers."""
    return rpc_probe(uri, "getPid")


def rpc_probe(uri: str, method: str, *args: RpcValue) -> Probe:
    """Return a probe that calls a method of a node (http://wiki.ros.org/ROS/Slave_API)."""
    body = encode(method, "/course", *args)
    request = HTTP_HEAD.format(len(body)).encode() + body
    return Probe(_address(uri), request, lambda answer: END in answer[-2 * len(END) :])


def rpc_answer(probe: Probe) -> RpcValue:
    """Return the value of a node's response, or None if the node did not respond or has no such method."""
    if not probe.answered:
        return None
    try:
        code, _, value = items(decode(probe.answer.partition(b"\r\n\r\n")[2]))
    except NO_ANSWER:
        return None
    return value if code == 1 else None


def encode_header(fields: dict[str, str]) -> bytes:
    """Return the length and the bytes of a connection header (http://wiki.ros.org/ROS/Connection Header)."""
    header: bytes = encode_ros_handshake_header(fields)
    return header


def header_fields(answer: bytes) -> dict[str, str]:
    """Return the fields of the connection header at the start of `answer`, or {} if there is no header."""
    try:
        fields: dict[str, str] = decode_ros_handshake_header(answer)
    except (ROSHandshakeException, struct.error, UnicodeDecodeError):
        return {}
    return fields


def _whole_header(answer: bytes) -> bool:
    return len(answer) >= 4 and len(answer) >= 4 + struct.unpack("<I", answer[:4])[0]


def _address(uri: str) -> tuple[str, int]:
    return uri.rpartition("://")[2].rstrip("/").rpartition(":")[0], port_of(uri)


def _resolved(host: str) -> str | None:
    try:
        return socket.gethostbyname(host)
    except OSError:
        return None


def _begin(probe: Probe, host: str | None, selector: selectors.BaseSelector) -> None:
    if host is None:
        probe.reach = Reach.LOST
        return
    sock = socket.socket()
    sock.setblocking(False)
    sock.connect_ex((host, probe.address[1]))
    selector.register(sock, selectors.EVENT_WRITE, probe)


def _go_on(key: selectors.SelectorKey, selector: selectors.BaseSelector) -> None:
    probe, sock = key.data, key.fileobj
    assert isinstance(sock, socket.socket)
    try:
        if key.events == selectors.EVENT_WRITE:
            sock.sendall(probe.request)
            selector.modify(sock, selectors.EVENT_READ, probe)
            return
        part = sock.recv(65536)
        probe.answer += part
        if probe.complete(probe.answer):
            probe.reach = Reach.ANSWERED
        elif part:
            return
        else:
            probe.reach = Reach.LOST
    except ConnectionRefusedError:
        probe.reach = Reach.REFUSED
    except OSError:
        probe.reach = Reach.LOST
    _end(key, selector)


def _end(key: selectors.SelectorKey, selector: selectors.BaseSelector) -> None:
    selector.unregister(key.fileobj)
    assert isinstance(key.fileobj, socket.socket)
    key.fileobj.close()
