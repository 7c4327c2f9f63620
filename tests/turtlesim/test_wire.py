"""What goes over the wire, byte by byte where a roscpp server differs from a rospy one."""

from __future__ import annotations

import socket
import struct
from io import BytesIO
from urllib.parse import urlparse

import pytest
from turtlesim.srv import Kill, Spawn

from course_pkg.graph import MasterClient, NodeProcess, PrivateMaster
from course_pkg.graph.probe import header_fields


def connected(master: PrivateMaster, at: str, **fields: str) -> tuple[socket.socket, dict[str, str]]:
    """Connect to a service by hand; return the socket and the header that came back."""
    address = urlparse(MasterClient(master.uri).lookup_service(at) or "")
    sock = socket.create_connection((address.hostname or "", address.port or 0), timeout=5)
    pairs = [f"{name}={value}".encode() for name, value in {"callerid": "/hand", **fields}.items()]
    body = b"".join(struct.pack("<I", len(pair)) + pair for pair in pairs)
    sock.sendall(struct.pack("<I", len(body)) + body)
    return sock, header_fields(framed(sock))


def framed(sock: socket.socket) -> bytes:
    """Read one block with its length before it; return it with the length."""
    size = exactly(sock, 4)
    return size + exactly(sock, struct.unpack("<I", size)[0])


def exactly(sock: socket.socket, count: int) -> bytes:
    """Read so many bytes."""
    data = b""
    while len(data) < count:
        more = sock.recv(count - len(data))
        assert more, "the node closed the connection"
        data += more
    return data


def request(message: object) -> bytes:
    """Return a request as it is sent."""
    body = BytesIO()
    message.serialize(body)  # type: ignore[attr-defined]
    return struct.pack("<I", len(body.getvalue())) + body.getvalue()


def test_the_header_names_both_halves(master: PrivateMaster, simulator: NodeProcess) -> None:
    """The fields of a roscpp server's answer, no more and no fewer."""
    sock, header = connected(master, "/spawn", service="/spawn", md5sum=Spawn._md5sum)
    sock.close()
    assert header == {
        "callerid": "/turtlesim",
        "md5sum": Spawn._md5sum,
        "request_type": "turtlesim/SpawnRequest",
        "response_type": "turtlesim/SpawnResponse",
        "type": "turtlesim/Spawn",
    }


def test_a_failure_is_a_zero_and_no_words(master: PrivateMaster, simulator: NodeProcess) -> None:
    """The ok byte 0 and a length of 0: five bytes."""
    sock, _ = connected(master, "/kill", service="/kill", md5sum=Kill._md5sum)
    with sock:
        sock.sendall(request(Kill._request_class("nobody")))
        assert exactly(sock, 5) == b"\0\0\0\0\0"
        assert sock.recv(1) == b""


def test_a_persistent_connection_takes_one_request_after_another(
    master: PrivateMaster, simulator: NodeProcess
) -> None:
    """After a failure too."""
    sock, _ = connected(master, "/kill", service="/kill", md5sum=Kill._md5sum, persistent="1")
    with sock:
        for _ in range(3):
            sock.sendall(request(Kill._request_class("nobody")))
            assert exactly(sock, 5) == b"\0\0\0\0\0"


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"service": "/kill", "md5sum": "0" * 32}, "client wants service /kill to have md5sum"),
        ({"service": "/nowhere", "md5sum": "*"}, "nonexistent service [/nowhere]"),
        ({"service": "/kill"}, "did not have required elements"),
    ],
)
def test_a_wrong_header_is_answered(
    master: PrivateMaster, simulator: NodeProcess, fields: dict[str, str], words: str
) -> None:
    """The answer's field `error` says in roscpp's words what is wrong."""
    sock, header = connected(master, "/kill", **fields)
    sock.close()
    assert words in header["error"]


def test_half_a_request_hurts_nobody(master: PrivateMaster, simulator: NodeProcess) -> None:
    """Clients that vanish in the middle of a request leave the node as it was."""
    for cut in (0, 1, 3, 4, 7):
        sock, _ = connected(master, "/spawn", service="/spawn", md5sum=Spawn._md5sum)
        sock.sendall(request(Spawn._request_class(1, 1, 0, "half"))[:cut])
        sock.close()
    sock, header = connected(master, "/kill", service="/kill", md5sum=Kill._md5sum)
    sock.close()
    assert header["type"] == "turtlesim/Kill"
