"""A faulty server fails as planned, each fault as the real one looks from outside, and is well afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
import rospy
from course_pkg.srv import geometry

from course_pkg.errors import CallTimeout
from course_pkg.examiner.faults import Crash, Fault, FaultyServer, Frozen, HangUp, Late, Refuse, Stumble
from course_pkg.examiner.node import Node
from course_pkg.examiner.plain import Message, Plain
from course_pkg.graph import BoundedProxy, MasterClient, PrivateMaster
from tests.support import eventually

# rospy's client leaves its sockets to the garbage collector.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
AWAY = 0.2  # s until a server that crashed is back


@pytest.fixture
def node(master: PrivateMaster) -> Node:
    """Give the server a name on the graph."""
    return Node("/tester", "http://localhost:1/", MasterClient(master.uri))


@pytest.fixture
def server(node: Node) -> Iterator[FaultyServer]:
    """A server whose work is to double a length."""
    with FaultyServer(node, "/f", geometry, lambda request: {"area": 2 * request.length}) as serving:
        yield serving
    assert node.master.lookup_service("/f") is None


def ask(length: float, timeout: float = 5.0) -> float:
    """Call in bounded time."""
    return float(BoundedProxy("/f", geometry, timeout=timeout).call(length, 0, 0).area)


def answered(length: float) -> bool:
    """Return whether a call brings the right answer, of a server that may not be back yet."""
    try:
        return ask(length) == 2 * length
    except rospy.ServiceException:
        return False


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        (Refuse("too small"), "responded with an error: b'service cannot process request: too small'"),
        (Stumble("no paper"), "responded with an error: b'error processing request: no paper'"),
        (HangUp(), "transport error completing service call"),
    ],
)
def test_a_planned_fault_befalls_one_call(server: FaultyServer, fault: Plain, words: str) -> None:
    """The client reads the words of the real fault, and the next call is answered."""
    server.plan.append(Fault(fault))
    with pytest.raises(rospy.ServiceException) as error:
        ask(1.0)
    assert words in str(error.value)
    assert ask(2.0) == 4.0
    assert (len(server.requests), len(server.arrivals)) == (2, 2)


def test_a_slow_answer_is_that_of_the_work(server: FaultyServer) -> None:
    """Who waits long enough gets what the work made."""
    server.plan.append(Fault(Late(0.05, {}), worked=True))
    assert ask(3.0) == 6.0


def test_a_frozen_server_takes_connections_and_says_nothing(server: FaultyServer) -> None:
    """A look finds it, as one finds a stopped process; a call gets no word, and uses the fault up."""
    server.plan.append(Fault(Frozen()))
    rospy.wait_for_service("/f", timeout=2)
    with pytest.raises(CallTimeout, match="takes connections and does not speak"):
        ask(1.0, timeout=0.2)
    assert (server.requests, len(server.arrivals)) == ([], 1)
    assert ask(2.0) == 4.0


@pytest.mark.parametrize(
    ("farewell", "words"), [(False, "Connection refused"), (True, r"service \[/f\] unavailable")]
)
def test_a_crash_leaves_what_the_real_one_leaves(server: FaultyServer, farewell: bool, words: str) -> None:
    """A killed server is listed and nobody is there, one that was shut down is not listed; both come back."""
    before = server._uri
    server.plan.append(Fault(Crash(AWAY, farewell)))
    with pytest.raises(rospy.ServiceException, match="transport error"):
        ask(1.0)
    with pytest.raises(rospy.ServiceException, match=words):
        ask(1.0)
    eventually(lambda: answered(2.0))
    assert server._uri != before


@pytest.mark.parametrize("worked", [True, False])
def test_work_is_done_before_a_fault_where_the_plan_says_so(node: Node, worked: bool) -> None:
    """Whether a call that brought no answer was carried out is the plan's to say."""
    done: list[float] = []

    def work(request: Message) -> dict[str, Plain]:
        done.append(request.length)
        return {}

    with FaultyServer(node, "/f", geometry, work) as server:
        server.plan.append(Fault(HangUp(), worked=worked))
        with pytest.raises(rospy.ServiceException):
            ask(1.0)
    assert done == ([1.0] if worked else [])


def test_a_server_that_left_while_it_was_away_stays_away(node: Node) -> None:
    """What comes back after the check would stand in somebody's way."""
    with FaultyServer(node, "/f", geometry, lambda _: {}) as server:
        server.plan.append(Fault(Crash(AWAY)))
        with pytest.raises(rospy.ServiceException):
            ask(1.0)
        (returning,) = server._returns
    returning.join(5)
    assert node.master.lookup_service("/f") is None


def test_calls_at_once_use_up_one_fault_each(server: FaultyServer) -> None:
    """Of eight calls at the same moment as many fail as faults were planned."""
    server.plan.extend([Fault(Refuse("busy"))] * 3)

    def fails(length: float) -> bool:
        try:
            return ask(length) != 2 * length
        except rospy.ServiceException:
            return True

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(fails, [float(number) for number in range(8)])) == 3
