"""The simulator's services, names and publishers behave like those of a roscpp node."""

from __future__ import annotations

import socket
import struct
from io import BytesIO
from types import SimpleNamespace
from urllib.parse import urlparse

import pytest
from turtlesim.srv import Kill, Spawn

from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster
from course_pkg.ros.protocol.probe import header_fields
from course_pkg.turtlesim.roscpp_services import name_error
from course_pkg.turtlesim.turtle_interface import publish_without_waiting


def connected(master: PrivateMaster, at: str, **fields: str) -> tuple[socket.socket, dict[str, str]]:
    """Connect to the server of a service, and send a header with the given fields.

    Return the socket and the server's header.
    """
    address = urlparse(MasterClient(master.uri).lookup_service(at) or "")
    sock = socket.create_connection((address.hostname or "", address.port or 0), timeout=5)
    pairs = [f"{name}={value}".encode() for name, value in {"callerid": "/hand", **fields}.items()]
    body = b"".join(struct.pack("<I", len(pair)) + pair for pair in pairs)
    sock.sendall(struct.pack("<I", len(body)) + body)
    return sock, header_fields(framed(sock))


def framed(sock: socket.socket) -> bytes:
    """Read a length of four bytes, and a block with this length; return the length and the block."""
    size = exactly(sock, 4)
    return size + exactly(sock, struct.unpack("<I", size)[0])


def exactly(sock: socket.socket, count: int) -> bytes:
    """Read exactly the given number of bytes."""
    data = b""
    while len(data) < count:
        more = sock.recv(count - len(data))
        assert more, "the node closed the connection"
        data += more
    return data


def request(message: object) -> bytes:
    """Return the bytes of a request: the length and then the fields."""
    body = BytesIO()
    message.serialize(body)  # type: ignore[attr-defined]
    return struct.pack("<I", len(body.getvalue())) + body.getvalue()


def test_the_header_names_the_types_of_request_and_response(
    master: PrivateMaster, simulator: NodeProcess
) -> None:
    """The header of the server's response has exactly the fields of a roscpp server."""
    sock, header = connected(master, "/spawn", service="/spawn", md5sum=Spawn._md5sum)
    sock.close()
    assert header == {
        "callerid": "/turtlesim",
        "md5sum": Spawn._md5sum,
        "request_type": "turtlesim/SpawnRequest",
        "response_type": "turtlesim/SpawnResponse",
        "type": "turtlesim/Spawn",
    }


def test_a_failed_call_sends_an_empty_error_message(master: PrivateMaster, simulator: NodeProcess) -> None:
    """If a call fails, the server sends the byte 0 (no success) and an empty error message."""
    sock, _ = connected(master, "/kill", service="/kill", md5sum=Kill._md5sum)
    with sock:
        sock.sendall(request(Kill._request_class("nobody")))
        assert exactly(sock, 5) == b"\0\0\0\0\0"
        assert sock.recv(1) == b""


def test_a_persistent_connection_takes_one_request_after_another(
    master: PrivateMaster, simulator: NodeProcess
) -> None:
    """After a failed call, the client can send another request on the same connection."""
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
    """If a header is wrong, the field `error` of the server's header contains roscpp's error message."""
    sock, header = connected(master, "/kill", **fields)
    sock.close()
    assert words in header["error"]


def test_an_incomplete_request_does_not_disturb_the_node(
    master: PrivateMaster, simulator: NodeProcess
) -> None:
    """After incomplete requests, the node still accepts connections."""
    for cut in (0, 1, 3, 4, 7):
        sock, _ = connected(master, "/spawn", service="/spawn", md5sum=Spawn._md5sum)
        sock.sendall(request(Spawn._request_class(1, 1, 0, "half"))[:cut])
        sock.close()
    sock, header = connected(master, "/kill", service="/kill", md5sum=Kill._md5sum)
    sock.close()
    assert header["type"] == "turtlesim/Kill"


@pytest.mark.parametrize("name", ["MyTurtle", "a", "a/b", "/left/turtle", "t_1"])
def test_valid_names(name: str) -> None:
    """A valid graph name causes no error message."""
    assert name_error(name) == ""


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("hello world", "Character [ ] at element [5] is not valid in Graph Resource Name [hello world]."),
        ("1st", "Character [1] is not valid as the first character in Graph Resource Name [1st]."),
        ("ä", "Character [ä] is not valid as the first character"),
        ("a-b", "Character [-] at element [1]"),
        ("a\n", "Character [\n] at element [1]"),
        ("~a", "Using ~ names"),
        (" ", "Character [ ] is not valid as the first character"),
    ],
)
def test_invalid_names(name: str, message: str) -> None:
    """If a name is invalid, the error message contains the wrong character and its position, as in roscpp."""
    assert message in name_error(name)


def test_a_subscriber_that_does_not_read_blocks_no_publisher() -> None:
    """A publisher drops messages while a subscriber does not read."""
    near, far = socket.socketpair()
    with near, far:
        near.setblocking(True)
        connection = SimpleNamespace(socket=near, write_data=lambda data: near.sendall(data) is None)
        impl = SimpleNamespace(queue_size=1, add_connection=lambda added: added)
        publish_without_waiting(SimpleNamespace(impl=impl))
        assert impl.add_connection(connection)
        writes = connection.write_data
        message = bytes(32)
        for _ in range(100_000):  # The loop sends more messages than the socket's buffer can store.
            assert writes(message)
        far.setblocking(False)
        taken = 0
        while True:
            try:
                taken += len(far.recv(1 << 20))
            except BlockingIOError:
                break
        assert 0 < taken < 100_000 * len(message)
        assert writes(b"again")
        assert far.recv(100) == b"again"
    assert impl.queue_size is None
