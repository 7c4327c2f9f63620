"""Tests of the relay that records the bytes of a call."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator

import pytest

from course_pkg.errors import FieldError
from course_pkg.ros import NodeProcess, PrivateMaster, record_call
from course_pkg.ros.wire.relay import MOST, Relay
from course_pkg.types import compile_service
from tests.support import stopped

SIDES = {"length": 1.0, "width": 2.0, "height": 3.0}
NAME, KIND = "/getGeometry", "course_pkg/geometry"


@pytest.fixture(scope="module", autouse=True)
def server(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the geometry server on a separate master."""
    assert master.uri
    with NodeProcess.rosrun("course_pkg", "server") as process:
        process.wait_for_service(NAME, timeout=20)
        yield process


@pytest.fixture
def echo() -> Iterator[int]:
    """Run a server that returns all received bytes and then sends `bye`; yield its port."""

    def serve() -> None:
        while True:
            try:
                sock, _ = listener.accept()
            except OSError:
                return
            with sock:
                while data := sock.recv(65536):
                    sock.sendall(data)
                sock.sendall(b"bye")

    with socket.create_server(("127.0.0.1", 0)) as listener:
        threading.Thread(target=serve, daemon=True).start()
        yield listener.getsockname()[1]
        listener.shutdown(socket.SHUT_RDWR)


def relay_threads() -> list[str]:
    """Return the names of the functions that the relays' threads are running."""
    targets = (getattr(thread, "_target", None) for thread in threading.enumerate())
    return [target.__qualname__ for target in targets if target is not None and "relay" in target.__module__]


def test_every_byte_is_forwarded_and_kept(echo: int) -> None:
    """The relay forwards and stores the bytes of both directions."""
    sent = bytes(range(256)) * 4000
    with Relay("127.0.0.1", echo) as relay, socket.create_connection(("127.0.0.1", relay.port)) as sock:
        came = b""
        threading.Thread(
            target=lambda: (sock.sendall(sent), sock.shutdown(socket.SHUT_WR)), daemon=True
        ).start()
        while data := sock.recv(65536):
            came += data
        relay.wait()
        (connection,) = relay.connections
    assert came == sent + b"bye"
    assert connection.data(from_client=True) == sent
    assert connection.data(from_client=False) == came
    assert connection.closed_by == "client"
    assert relay_threads() == []


def test_bytes_beyond_the_limit_are_forwarded_and_counted(echo: int) -> None:
    """The relay forwards all bytes, but stores only the first bytes up to a limit."""
    sent = bytes(MOST + 100_000)
    with Relay("127.0.0.1", echo) as relay, socket.create_connection(("127.0.0.1", relay.port)) as sock:
        threading.Thread(
            target=lambda: (sock.sendall(sent), sock.shutdown(socket.SHUT_WR)), daemon=True
        ).start()
        came = 0
        while data := sock.recv(65536):
            came += len(data)
        relay.wait()
        (connection,) = relay.connections
    assert came == len(sent) + 3
    kept = len(connection.data(from_client=True)) + len(connection.data(from_client=False))
    assert kept <= 2 * MOST
    assert kept + connection.lost == len(sent) + came


def test_a_relay_to_an_unreachable_server() -> None:
    """If the server cannot be reached, the relay closes the client's connection and stores the reason."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    with Relay("127.0.0.1", port) as relay:
        with socket.create_connection(("127.0.0.1", relay.port)) as sock:
            assert sock.recv(1) == b""
        assert "refused" in relay.connections[0].refused.lower()


def test_a_closed_relay_ends_its_connections(echo: int) -> None:
    """close() closes the port and all connections of the relay."""
    relay = Relay("127.0.0.1", echo)
    with socket.create_connection(("127.0.0.1", relay.port)) as sock:
        sock.sendall(b"x")
        assert sock.recv(1) == b"x"
        relay.close()
        sock.settimeout(5)
        assert sock.recv(10) in (b"", b"bye")
    with pytest.raises(OSError, match="refused"):
        socket.create_connection(("127.0.0.1", relay.port))
    assert relay_threads() == []


def test_a_call_is_recorded_as_rospy_makes_it() -> None:
    """record_call() records a call and returns the unchanged response."""
    wire = record_call(NAME, fields=SIDES, headers={"session": "alice"})
    assert wire.error == ""
    assert (wire.response.area, wire.response.volume) == (2.0, 6.0)
    assert wire.lookup is not None
    assert b"lookupService" in wire.lookup.data(from_client=True)
    (connection,) = wire.connections
    assert b"session=alice" in connection.data(from_client=True)
    assert connection.data(from_client=False).endswith(b"\x08\0\0\0\0\0\0\x40\0\0\xc0\x40")
    assert relay_threads() == []


def test_a_failed_call_is_recorded_and_a_wrong_field_is_an_error() -> None:
    """The record of a failed call contains the server's error message."""
    other = compile_service(
        KIND, "int32 length\nint32 width\nint32 height\n---\nfloat32 area\nfloat32 volume"
    )
    assert "cannot process request" in record_call(NAME, fields={**SIDES, "length": -1.0}).error
    assert "md5sums do not match" in record_call(NAME, other).error
    assert "unavailable" in record_call("/nobody").error
    assert "unavailable" in record_call("/nobody", KIND, fields=SIDES).error
    with pytest.raises(FieldError, match="hieght"):
        record_call(NAME, fields={"hieght": 1.0})
    assert relay_threads() == []


def test_a_call_of_a_stopped_server_is_recorded(server: NodeProcess) -> None:
    """If a call times out, the record contains only the sent bytes."""
    with stopped(server.pid):
        wire = record_call(NAME, KIND, fields=SIDES, timeout=0.5)
    assert "no answer within 0.5 s" in wire.error
    (connection,) = wire.connections
    assert b"service=/getGeometry" in connection.data(from_client=True)
    assert connection.data(from_client=False) == b""
    assert relay_threads() == []
