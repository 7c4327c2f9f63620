"""The relay passes on every byte, and the tap stands in for a server and gives the name back."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator

import pytest
import rospy

from course_pkg.errors import FieldError, GraphError
from course_pkg.graph import MasterClient, NodeProcess, PrivateMaster, Wiretap, record_call
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.relay import MOST, Relay
from course_pkg.interfaces import compile_service
from tests.support import stopped

SIDES = {"length": 1.0, "width": 2.0, "height": 3.0}
NAME, KIND = "/getGeometry", "course_pkg/geometry"


@pytest.fixture(scope="module", autouse=True)
def server(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the geometry server on a master of its own."""
    assert master.uri
    with NodeProcess.rosrun("course_pkg", "server") as process:
        process.wait_for_service(NAME, timeout=20)
        yield process


@pytest.fixture
def echo() -> Iterator[int]:
    """A port that sends back what it gets, and says goodbye when that ends."""

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
    """Return the threads of relays that are still there."""
    targets = (getattr(thread, "_target", None) for thread in threading.enumerate())
    return [target.__qualname__ for target in targets if target is not None and "relay" in target.__module__]


def test_every_byte_is_passed_on_and_kept(echo: int) -> None:
    """Both directions arrive as they were sent, the end of one direction included; then nothing is left."""
    sent = bytes(range(256)) * 4000
    with Relay("127.0.0.1", echo) as relay, socket.create_connection(("127.0.0.1", relay.port)) as sock:
        came = b""
        threading.Thread(
            target=lambda: (sock.sendall(sent), sock.shutdown(socket.SHUT_WR)), daemon=True
        ).start()
        while data := sock.recv(65536):
            came += data
        relay.settle()
        (spoken,) = relay.conversations
    assert came == sent + b"bye"
    assert spoken.said(by_client=True) == sent
    assert spoken.said(by_client=False) == came
    assert spoken.closed_by == "client"
    assert relay_threads() == []


def test_what_is_too_much_is_passed_on_and_counted(echo: int) -> None:
    """The record is bounded, and what is passed on is not."""
    sent = bytes(MOST + 100_000)
    with Relay("127.0.0.1", echo) as relay, socket.create_connection(("127.0.0.1", relay.port)) as sock:
        threading.Thread(
            target=lambda: (sock.sendall(sent), sock.shutdown(socket.SHUT_WR)), daemon=True
        ).start()
        came = 0
        while data := sock.recv(65536):
            came += len(data)
        relay.settle()
        (spoken,) = relay.conversations
    assert came == len(sent) + 3
    kept = len(spoken.said(by_client=True)) + len(spoken.said(by_client=False))
    assert kept <= 2 * MOST
    assert kept + spoken.lost == len(sent) + came


def test_a_relay_to_nobody_says_so() -> None:
    """The one who connects is hung up on, and the reason is on record."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    with Relay("127.0.0.1", port) as relay:
        with socket.create_connection(("127.0.0.1", relay.port)) as sock:
            assert sock.recv(1) == b""
        assert "refused" in relay.conversations[0].refused.lower()


def test_a_closed_relay_ends_its_connections(echo: int) -> None:
    """Whoever is connected through it notices, and its port is free."""
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
    """The look-up and the connection are on record, and the answer is what it would have been."""
    wire = record_call(NAME, fields=SIDES, headers={"session": "alice"})
    assert wire.error == ""
    assert (wire.response.area, wire.response.volume) == (2.0, 6.0)
    assert wire.lookup is not None
    assert b"lookupService" in wire.lookup.said(by_client=True)
    (spoken,) = wire.conversations
    assert b"session=alice" in spoken.said(by_client=True)
    assert spoken.said(by_client=False).endswith(b"\x08\0\0\0\0\0\0\x40\0\0\xc0\x40")
    assert relay_threads() == []


def test_a_failed_call_is_on_record_and_a_wrong_field_is_an_error() -> None:
    """What the other side does is shown; what is wrong here is said at once."""
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


def test_a_frozen_server_is_on_record(server: NodeProcess) -> None:
    """A call that ends with its deadline shows what was sent, and that nothing came."""
    with stopped(server.pid):
        wire = record_call(NAME, KIND, fields=SIDES, timeout=0.5)
    assert "no answer within 0.5 s" in wire.error
    (spoken,) = wire.conversations
    assert b"service=/getGeometry" in spoken.said(by_client=True)
    assert spoken.said(by_client=False) == b""
    assert relay_threads() == []


def test_a_tap_sees_any_client_and_gives_the_name_back(master: PrivateMaster) -> None:
    """While it lasts the master leads to the relay; afterwards, and after an error, to the server."""
    client = MasterClient(master.uri)
    before, owner = client.lookup_service(NAME), client.system_state().services[NAME]
    with Wiretap(NAME) as wire:
        assert client.lookup_service(NAME) != before
        assert client.system_state().services[NAME] == owner
        for number in (1.0, 2.0):
            assert BoundedProxy(NAME, KIND).call(number, 2.0, 3.0).area == 2.0 * number
    assert len(wire.conversations) == 2
    assert client.lookup_service(NAME) == before
    with pytest.raises(ZeroDivisionError), Wiretap(NAME):
        raise ZeroDivisionError
    assert client.lookup_service(NAME) == before
    assert BoundedProxy(NAME, KIND).call(**SIDES).area == 2.0
    assert relay_threads() == []


def test_a_tap_ends_soon_under_a_persistent_connection() -> None:
    """Such a connection through it is cut, and what passed until then is on record."""
    proxy = BoundedProxy(NAME, KIND, persistent=True)
    with Wiretap(NAME) as wire:
        proxy.call(**SIDES)
        proxy.call(**SIDES)
    proxy.close()
    (spoken,) = wire.conversations
    assert spoken.said(by_client=True).count(b"\x0c\0\0\0\0\0\x80\x3f") == 2
    assert relay_threads() == []


def test_a_tap_leaves_a_name_that_was_taken_over_alone(master: PrivateMaster) -> None:
    """A server that registered meanwhile is the last one, and stays it."""
    client = MasterClient(master.uri)
    before = client.lookup_service(NAME)
    assert before is not None
    with Wiretap(NAME):
        client.register_service("/other", NAME, "rosrpc://localhost:1", "http://localhost:1/")
    assert client.lookup_service(NAME) == "rosrpc://localhost:1"
    client.register_service("/SERVER_NODE", NAME, before, client.lookup_node("/SERVER_NODE") or "")


def test_nobody_to_tap() -> None:
    """Without a server there is nothing to stand in for."""
    with pytest.raises(GraphError, match="Nobody serves /nobody"), Wiretap("nobody"):
        pass
    assert rospy.resolve_name("nobody") == "/nobody"
