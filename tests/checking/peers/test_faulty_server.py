"""Tests of faulty servers, which fail as planned and then work again."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
import rospy
from course_pkg.srv import geometry

from course_pkg.checking.peers.faulty_server import Crash, Fault, FaultyServer, Frozen, Stumble
from course_pkg.checking.peers.node import Node
from course_pkg.checking.peers.scripted_server import HangUp, Late, Refuse
from course_pkg.checking.plain_values import Message
from course_pkg.errors import CallTimeout
from course_pkg.ros import BoundedProxy, MasterClient, PrivateMaster
from course_pkg.ros.protocol.json_channel import Json
from tests.support import eventually

# rospy's client does not close its sockets; the garbage collector closes the sockets later.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
AWAY = 0.2  # A crashed server is started again after this time in s.


@pytest.fixture
def node(master: PrivateMaster) -> Node:
    """Return the object that represents the check's own node."""
    return Node("/tester", "http://localhost:1/", MasterClient(master.uri))


@pytest.fixture
def server(node: Node) -> Iterator[FaultyServer]:
    """Run a server that multiplies the requested length by 2."""
    with FaultyServer(node, "/f", geometry, lambda request: {"area": 2 * request.length}) as serving:
        yield serving
    assert node.master.lookup_service("/f") is None


def ask(length: float, timeout: float = 5.0) -> float:
    """Call the server with a time limit, and return the field `area` of the response."""
    return float(BoundedProxy("/f", geometry, timeout=timeout).call(length, 0, 0).area)


def answered(length: float) -> bool:
    """Return whether a call gets the right response."""
    try:
        return ask(length) == 2 * length
    except rospy.ServiceException:
        return False


@pytest.mark.parametrize(
    ("fault", "text"),
    [
        (Refuse("too small"), "responded with an error: b'service cannot process request: too small'"),
        (Stumble("no paper"), "responded with an error: b'error processing request: no paper'"),
        (HangUp(), "transport error completing service call"),
    ],
)
def test_planned_fault_affects_one_call(server: FaultyServer, fault: Json, text: str) -> None:
    """A planned fault causes an error in one call of a rospy client, and the next call succeeds."""
    server.plan.append(Fault(fault))
    with pytest.raises(rospy.ServiceException) as error:
        ask(1.0)
    assert text in str(error.value)
    assert ask(2.0) == 4.0
    assert (len(server.requests), len(server.arrivals)) == (2, 2)


def test_late_response_is_right(server: FaultyServer) -> None:
    """If a response is late, a client with a long timeout still gets the right response."""
    server.plan.append(Fault(Late(0.05, {}), worked=True))
    assert ask(3.0) == 6.0


def test_frozen_server_accepts_connections_without_a_response(server: FaultyServer) -> None:
    """A server with the fault Frozen accepts a connection, but sends no response."""
    server.plan.append(Fault(Frozen()))
    rospy.wait_for_service("/f", timeout=2)
    with pytest.raises(CallTimeout, match="accepts connections, but sends nothing"):
        ask(1.0, timeout=0.2)
    assert (server.requests, len(server.arrivals)) == ([], 1)
    assert ask(2.0) == 4.0


@pytest.mark.parametrize(
    ("unregisters", "text"), [(False, "Connection refused"), (True, r"service \[/f\] unavailable")]
)
def test_registration_after_a_crash(server: FaultyServer, unregisters: bool, text: str) -> None:
    """A killed server stays registered, and a server that was shut down is unregistered."""
    before = server._uri
    server.plan.append(Fault(Crash(AWAY, unregisters)))
    with pytest.raises(rospy.ServiceException, match="transport error"):
        ask(1.0)
    with pytest.raises(rospy.ServiceException, match=text):
        ask(1.0)
    eventually(lambda: answered(2.0))
    assert server._uri != before


@pytest.mark.parametrize("worked", [True, False])
def test_plan_decides_whether_the_work_is_done(node: Node, worked: bool) -> None:
    """When a call fails as planned, the handler runs only if the fault's field `worked` is True."""
    done: list[float] = []

    def work(request: Message) -> dict[str, Json]:
        done.append(request.length)
        return {}

    with FaultyServer(node, "/f", geometry, work) as server:
        server.plan.append(Fault(HangUp(), worked=worked))
        with pytest.raises(rospy.ServiceException):
            ask(1.0)
    assert done == ([1.0] if worked else [])


def test_server_that_has_left_does_not_restart(node: Node) -> None:
    """A server that was closed does not start again."""
    with FaultyServer(node, "/f", geometry, lambda _: {}) as server:
        server.plan.append(Fault(Crash(AWAY)))
        with pytest.raises(rospy.ServiceException):
            ask(1.0)
        (returning,) = server._restarts
    returning.join(5)
    assert node.master.lookup_service("/f") is None


def test_simultaneous_calls_take_one_fault_each(server: FaultyServer) -> None:
    """If three faults are planned, three of eight simultaneous calls fail."""
    server.plan.extend([Fault(Refuse("busy"))] * 3)

    def fails(length: float) -> bool:
        try:
            return ask(length) != 2 * length
        except rospy.ServiceException:
            return True

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(fails, [float(number) for number in range(8)])) == 3
