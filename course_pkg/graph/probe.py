"""Asking many sockets one thing each, all at the same time, in bounded time and on one thread."""

from __future__ import annotations

import selectors
import socket
import struct
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, dumps, loads

END = b"</methodResponse>"  # of an answer by XML-RPC


class Reach(Enum):
    """How far a probe came."""

    ANSWERED = "answered"
    REFUSED = "refused"  # nobody listens there: the process is gone
    SILENT = "silent"  # somebody listens and says nothing: stopped, or busy
    LOST = "lost"  # no way there, or hung up half way


@dataclass
class Probe:
    """One question to one address; `complete` says whether the bytes so far are the whole answer."""

    address: tuple[str, int]
    question: bytes
    complete: Callable[[bytes], bool]
    answer: bytes = b""
    reach: Reach = field(default=Reach.SILENT)

    @property
    def answered(self) -> bool:
        """Whether a whole answer came."""
        return self.reach is Reach.ANSWERED


def ask_all(probes: Sequence[Probe], timeout: float) -> None:
    """Fill in answer and reach of all probes; return when all are settled, or after `timeout` s."""
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
    """Return a probe for the type of a service; TCPROS, as wait_for_service asks it."""
    fields = {"probe": "1", "md5sum": "*", "callerid": "/course", "service": name}
    pairs = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(struct.pack("<I", len(pair)) + pair for pair in pairs)
    return Probe(_address(uri), struct.pack("<I", len(body)) + body, _whole_header)


def node_probe(uri: str) -> Probe:
    """Return a probe that shows whether a node answers; getPid of the slave API."""
    return rpc_probe(uri, "getPid")


def rpc_probe(uri: str, method: str, *arguments: Any) -> Probe:  # noqa: ANN401 -- what XML-RPC can carry
    """Return a probe that asks a node by XML-RPC; http://wiki.ros.org/ROS/Slave_API."""
    body = dumps(("/course", *arguments), method).encode()
    head = f"POST /RPC2 HTTP/1.0\r\nContent-Type: text/xml\r\nContent-Length: {len(body)}\r\n\r\n"
    return Probe(_address(uri), head.encode() + body, lambda answer: END in answer[-2 * len(END) :])


def rpc_answer(probe: Probe) -> Any:  # noqa: ANN401 -- of any type
    """Return the value that a node has answered by XML-RPC, or None if it has not, or does not know how."""
    if not probe.answered:
        return None
    try:
        answer: Any = loads(probe.answer.partition(b"\r\n\r\n")[2])[0][0]
        code, _, value = answer
    except (ExpatError, Fault, LookupError, TypeError, ValueError):
        return None
    return value if code == 1 else None


def header_fields(answer: bytes) -> dict[str, str]:
    """Return the fields of a connection header; http://wiki.ros.org/ROS/TCPROS."""
    fields, rest = {}, answer[4:]
    while len(rest) >= 4:
        (length,) = struct.unpack("<I", rest[:4])
        key, _, value = rest[4 : 4 + length].decode("utf-8", "replace").partition("=")
        fields[key], rest = value, rest[4 + length :]
    return fields


def _whole_header(answer: bytes) -> bool:
    return len(answer) >= 4 and len(answer) >= 4 + struct.unpack("<I", answer[:4])[0]


def _address(uri: str) -> tuple[str, int]:
    host, _, port = uri.rpartition("://")[2].rstrip("/").rpartition(":")
    return host, int(port) if port.isdigit() else 0


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
            sock.sendall(probe.question)
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
