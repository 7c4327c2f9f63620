"""A scripted server does what its script says, and gives back the name that it took."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import pytest
import rospy
from course_pkg.srv import AddTwoInts, geometry

from course_pkg.examiner.node import Node
from course_pkg.examiner.scripted import Absent, Act, HangUp, Late, Refuse, ScriptedServer, Silence
from course_pkg.graph import MasterClient, PrivateMaster
from tests.support import eventually

# rospy's client leaves its sockets to the garbage collector.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")


@pytest.fixture
def node(master: PrivateMaster) -> Node:
    """Give the scripts a name on the graph."""
    return Node("/tester", "http://localhost:1/", MasterClient(master.uri))


def ask(name: str, *sides: float) -> tuple[float, float]:
    """Call as a student would."""
    response = rospy.ServiceProxy(name, geometry)(*sides)
    return response.area, response.volume


def test_it_answers_and_keeps_what_it_was_asked(node: Node) -> None:
    """A client of rospy's gets the answer; the request is on record."""
    with ScriptedServer(node, "/a", geometry, lambda r: {"area": r.length, "volume": 2.0}) as server:
        rospy.wait_for_service("/a", timeout=2)
        assert ask("/a", 1.5, 2.0, 3.0) == (1.5, 2.0)
        assert server.requests == [{"length": 1.5, "width": 2.0, "height": 3.0}]
        assert server.seen.probes == 1
    assert node.master.lookup_service("/a") is None


def test_a_persistent_client_stays_connected(node: Node) -> None:
    """One connection carries many calls when the client asks for that."""
    with ScriptedServer(node, "/p", geometry, lambda _: {}) as server:
        proxy = rospy.ServiceProxy("/p", geometry, persistent=True)
        for _ in range(3):
            proxy(1, 2, 3)
        proxy.close()
        assert (len(server.requests), len(server.seen.headers)) == (3, 1)


def test_whoever_stays_connected_is_left(node: Node) -> None:
    """When the server leaves, a connection on which nothing is said is closed, too."""
    with ScriptedServer(node, "/p", geometry, lambda _: {}):
        proxy = rospy.ServiceProxy("/p", geometry, persistent=True)
        proxy(1, 2, 3)
    with pytest.raises((rospy.ServiceException, rospy.exceptions.TransportException)):
        proxy(1, 2, 3)
    proxy.close()


@pytest.mark.parametrize(
    ("act", "words"),
    [
        (Refuse("too small"), "responded with an error: b'service cannot process request: too small'"),
        (HangUp(), "transport error completing service call"),
    ],
)
def test_misbehaviour_is_what_rospy_words_it(node: Node, act: Act, words: str) -> None:
    """A refusal and a death during the call are told as those of any server."""
    with ScriptedServer(node, "/m", geometry, lambda _: act), pytest.raises(rospy.ServiceException) as error:
        ask("/m", 1, 2, 3)
    assert words in str(error.value)


def test_another_definition_is_refused(node: Node) -> None:
    """As by rospy's server: with both MD5 sums."""
    with (
        ScriptedServer(node, "/d", AddTwoInts, lambda _: {"sum": 1}),
        pytest.raises(rospy.ServiceException, match="md5sums do not match"),
    ):
        ask("/d", 1, 2, 3)


def test_late_and_silent(node: Node) -> None:
    """A late answer comes; silence lasts until the script is over."""
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
    """The master forgets who served a name before; the examiner does not."""
    former = Node("/student", "http://localhost:2/", node.master)
    node.master.register_service(former.name, "/t", "rosrpc://localhost:3", former.uri)
    with take(node):
        assert node.master.lookup_service("/t") != "rosrpc://localhost:3"
    registration = node.registration("/t")
    assert registration
    assert (registration.node, registration.uri) == ("/student", "rosrpc://localhost:3")
    node.master.unregister_service("/student", "/t", "rosrpc://localhost:3")


def test_a_stale_entry_leads_nowhere(node: Node) -> None:
    """As after a kill: the master lists a server, and nobody is there."""
    with Absent(node, "/x", stale=True), pytest.raises(rospy.ServiceException, match="Connection refused"):
        ask("/x", 1, 2, 3)
    assert node.master.lookup_service("/x") is None
