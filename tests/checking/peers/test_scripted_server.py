"""A scripted server sends prepared responses and then restores the previous server."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import pytest
import rospy
from course_pkg.srv import AddTwoInts, geometry

from course_pkg.checking.peers.node import Node
from course_pkg.checking.peers.scripted_server import (
    Absent,
    Act,
    HangUp,
    Late,
    Refuse,
    ScriptedServer,
    Silence,
)
from course_pkg.ros import MasterClient, PrivateMaster
from tests.support import eventually

# rospy's client does not close its sockets; the garbage collector closes the sockets later.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")


@pytest.fixture
def node(master: PrivateMaster) -> Node:
    """Return the object that represents the check's own node."""
    return Node("/tester", "http://localhost:1/", MasterClient(master.uri))


def ask(name: str, *sides: float) -> tuple[float, float]:
    """Call the service like a student's client."""
    response = rospy.ServiceProxy(name, geometry)(*sides)
    return response.area, response.volume


def test_request_gets_its_response_and_is_stored(node: Node) -> None:
    """A rospy client gets the response, and the server stores the request."""
    with ScriptedServer(node, "/a", geometry, lambda r: {"area": r.length, "volume": 2.0}) as server:
        rospy.wait_for_service("/a", timeout=2)
        assert ask("/a", 1.5, 2.0, 3.0) == (1.5, 2.0)
        assert server.requests == [{"length": 1.5, "width": 2.0, "height": 3.0}]
        assert server.received.probes == 1
    assert node.master.lookup_service("/a") is None


def test_a_persistent_client_stays_connected(node: Node) -> None:
    """A persistent client makes all calls over one connection."""
    with ScriptedServer(node, "/p", geometry, lambda _: {}) as server:
        proxy = rospy.ServiceProxy("/p", geometry, persistent=True)
        for _ in range(3):
            proxy(1, 2, 3)
        proxy.close()
        assert (len(server.requests), len(server.received.headers)) == (3, 1)


def test_idle_connections_are_closed(node: Node) -> None:
    """When the server stops, the server also closes idle connections."""
    with ScriptedServer(node, "/p", geometry, lambda _: {}):
        proxy = rospy.ServiceProxy("/p", geometry, persistent=True)
        proxy(1, 2, 3)
    with pytest.raises((rospy.ServiceException, rospy.exceptions.TransportException)):
        proxy(1, 2, 3)
    proxy.close()


@pytest.mark.parametrize(
    ("act", "text"),
    [
        (Refuse("too small"), "responded with an error: b'service cannot process request: too small'"),
        (HangUp(), "transport error completing service call"),
    ],
)
def test_error_messages_are_those_of_rospy(node: Node, act: Act, text: str) -> None:
    """If a call is refused or interrupted, the client's error message is the same as with a rospy server."""
    with ScriptedServer(node, "/m", geometry, lambda _: act), pytest.raises(rospy.ServiceException) as error:
        ask("/m", 1, 2, 3)
    assert text in str(error.value)


def test_another_definition_is_refused(node: Node) -> None:
    """If the service definitions differ, the error message contains both MD5 sums."""
    with (
        ScriptedServer(node, "/d", AddTwoInts, lambda _: {"sum": 1}),
        pytest.raises(rospy.ServiceException, match="md5sums do not match"),
    ):
        ask("/d", 1, 2, 3)


def test_late_and_silent(node: Node) -> None:
    """A late response reaches the client. A call without a response ends when the server stops."""
    with ScriptedServer(node, "/l", geometry, lambda _: Late(0.05, {"area": 4.0})):
        assert ask("/l", 1, 2, 3) == (4.0, 0.0)
    with ScriptedServer(node, "/s", geometry, lambda _: Silence()) as server:
        asked = ThreadPoolExecutor(1).submit(ask, "/s", 1, 2, 3)
        eventually(lambda: server.requests)
        assert not asked.done()
    with pytest.raises(rospy.ServiceException):
        asked.result(5)


@pytest.mark.parametrize(
    "take", [lambda node: ScriptedServer(node, "/t", geometry, lambda _: {}), lambda node: Absent(node, "/t")]
)
def test_the_former_server_serves_again(node: Node, take: Callable[[Node], ScriptedServer | Absent]) -> None:
    """When the scripted server stops, the check registers the previous server with the master again."""
    former = Node("/student", "http://localhost:2/", node.master)
    node.master.register_service(former.name, "/t", "rosrpc://localhost:3", former.uri)
    with take(node):
        assert node.master.lookup_service("/t") != "rosrpc://localhost:3"
    registration = node.registration("/t")
    assert registration
    assert (registration.node, registration.uri) == ("/student", "rosrpc://localhost:3")
    node.master.unregister_service("/student", "/t", "rosrpc://localhost:3")


def test_stale_registration_has_a_closed_port(node: Node) -> None:
    """A stale registration contains a closed port.

    At the end of the `with` block, this registration is removed.
    """
    with Absent(node, "/x", stale=True), pytest.raises(rospy.ServiceException, match="Connection refused"):
        ask("/x", 1, 2, 3)
    assert node.master.lookup_service("/x") is None
