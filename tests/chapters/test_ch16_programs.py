"""Tests of the programs of chapter 16: the websocket bridge, and the robot that fetches things."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

import pytest
import websocket

from course_pkg.chapters.ch16_go_further.programs.bridge import JSON
from course_pkg.ros import NodeProcess
from course_pkg.ros.process.supervised import listening_ports
from tests.kernel import Kernel
from tests.support import program

pytestmark = pytest.mark.usefixtures("master")

SIDES = {"length": 1.5, "width": 2.0, "height": 3.0}


@pytest.fixture
def geometry() -> Iterator[NodeProcess]:
    """Run the course's geometry server."""
    with NodeProcess(["rosrun", "course_pkg", "server"]) as process:
        process.wait_for_service("/getGeometry")
        yield process


@pytest.fixture
def bridge() -> Iterator[NodeProcess]:
    """Start the websocket bridge, and wait until the bridge prints its address."""
    with NodeProcess(["rosrun", "course_pkg", "bridge", "_port:=0"]) as process:
        process.wait_for_output("ws://", timeout=20)
        yield process


@pytest.fixture
def line(bridge: NodeProcess) -> Iterator[websocket.WebSocket]:
    """Open a websocket connection to the bridge."""
    found = re.search(r"ws://\S+\d", bridge.output())
    assert found
    connection = websocket.create_connection(found[0], timeout=20)
    yield connection
    connection.close()


def said(line: websocket.WebSocket, message: JSON) -> dict[str, JSON]:
    """Send one message to the bridge, and return the reply."""
    line.send(message if isinstance(message, str) else json.dumps(message))
    answer: dict[str, JSON] = json.loads(line.recv())
    return answer


def call(service: str, args: JSON, **more: str) -> dict[str, JSON]:
    """Return a message that requests a service call."""
    return {"op": "call_service", "service": service, "args": args, **more}


@pytest.mark.parametrize("args", [SIDES, [1.5, 2.0, 3.0]], ids=["by name", "by position"])
def test_reply_to_a_call_contains_the_response(
    line: websocket.WebSocket, geometry: NodeProcess, args: object
) -> None:
    """The reply to a service call contains the service, the call's id, the response, and the result true."""
    assert said(line, call("/getGeometry", args, id="mine")) == {
        "op": "service_response",
        "id": "mine",
        "service": "/getGeometry",
        "values": {"area": 3.0, "volume": 9.0},
        "result": True,
    }


FAILED_CALLS: list[tuple[str, JSON, str]] = [
    ("/getGeometry", {"length": -1.0}, "cannot process request: length is -1"),
    ("/getGeometry", {"hieght": 1.0}, "No field name"),
    ("/getGeometry", [1.0], "Not enough arguments"),
    ("/getGeometry", "a text", "must be an object"),
    ("/getGeometry", 5, "must be an object"),
    ("/getGeometry", {"length": "long"}, "length"),
    ("/nobody", {}, "not available"),
]


def test_failed_call_gets_its_error_message(line: websocket.WebSocket, geometry: NodeProcess) -> None:
    """If a call fails, the reply contains the result false and the error message."""
    for service, args, words in FAILED_CALLS:
        answer = said(line, call(service, args))
        assert answer["result"] is False
        assert words in answer["values"]
        assert said(line, call("/getGeometry", SIDES))["result"] is True


def test_message_that_is_not_a_call_gets_a_status(line: websocket.WebSocket) -> None:
    """If a message is not a service call, the bridge replies with a status of the level "error"."""
    for message in ("no JSON", "[]", "7", {"op": "publish"}, {"op": "call_service"}):
        answer = said(line, message)
        assert (answer["op"], answer["level"]) == ("status", "error")


def test_nested_message_becomes_an_object(line: websocket.WebSocket) -> None:
    """The reply contains a nested ROS message as a nested JSON object."""
    loggers = said(line, call("/bridge/get_loggers", {}))["values"]["loggers"]
    assert {"name", "level"} == set(loggers[0])


def test_bridge_ends_with_an_open_connection(line: websocket.WebSocket, bridge: NodeProcess) -> None:
    """Ctrl-C ends the bridge without a traceback, even while a connection is open."""
    bridge.interrupt()
    assert bridge.wait() == 0
    assert "Traceback" not in bridge.output()


def test_bridge_listens_only_on_loopback(bridge: NodeProcess) -> None:
    """The bridge does not accept connections from other machines."""
    port = int(bridge.output().rpartition(":")[2].split()[0])
    assert port in listening_ports(bridge.pid)
    with open("/proc/net/tcp") as table:
        addresses = [row.split()[1] for row in table if row.split()[1].endswith(f":{port:04X}")]
    assert addresses[0].startswith("0100007F")


def test_bridge_reports_a_port_in_use(bridge: NodeProcess) -> None:
    """If the port is in use, the output contains the port number, and the exit status is 1."""
    port = bridge.output().rpartition(":")[2].split()[0]
    done = program("bridge", f"_port:={port}", "__name:=second")
    assert done.returncode == 1
    assert f"Port {port} is not available" in done.stderr + done.stdout


FETCHING = """
import actionlib, rospy, threading
from actionlib import CommState, GoalStatus
from course_pkg.ros import join
from course_pkg.msg import FetchAction, FetchGoal
from course_pkg.waiting import wait_until
node = join("asking")
client = actionlib.SimpleActionClient("/fetch", FetchAction)
assert client.wait_for_server(rospy.Duration(20))
told, third = [], threading.Event()

def tell(feedback):
    told.append(feedback.fetched)
    if feedback.fetched == 3:
        third.set()

def carry_out(goal):
    # wait_for_result() misses a goal that ends before send_goal() returns
    client.send_goal(goal)
    wait_until(lambda: client.gh.get_comm_state() == CommState.DONE, 20)
"""


@pytest.fixture
def asking(kernel: Kernel) -> Iterator[Kernel]:
    """Start the robot's node, and a kernel with an action client."""
    with NodeProcess(["rosrun", "course_pkg", "fetcher"]):
        kernel.run(FETCHING)
        yield kernel


def test_goal_succeeds_with_feedback(asking: Kernel) -> None:
    """The robot fetches all things and sends feedback after each thing."""
    counts, fetched, succeeded = asking.run("""
        client.send_goal(FetchGoal(things=5, seconds=0.05), feedback_cb=tell)
        assert client.wait_for_result(rospy.Duration(20))
        result = [told, client.get_result().fetched, client.get_state() == GoalStatus.SUCCEEDED]
    """)
    assert counts[:4] == [1, 2, 3, 4]
    assert (fetched, succeeded) == (5, True)


def test_cancelled_goal_returns_the_number_so_far(asking: Kernel) -> None:
    """After a goal is cancelled, the result contains the number of things that the robot has fetched."""
    fetched, preempted = asking.run("""
        client.send_goal(FetchGoal(things=500, seconds=0.05), feedback_cb=tell)
        assert third.wait(20)
        client.cancel_goal()
        assert client.wait_for_result(rospy.Duration(20))
        result = [client.get_result().fetched, client.get_state() == GoalStatus.PREEMPTED]
    """)
    assert 3 <= fetched < 500
    assert preempted


@pytest.mark.parametrize(
    "goal", ["things=-1, seconds=0.1", "things=1, seconds=-1", "things=1, seconds=float('nan')"]
)
def test_impossible_goal_is_aborted_with_a_message(asking: Kernel, goal: str) -> None:
    """The robot aborts an impossible goal, and the result contains an error message."""
    aborted, words, after = asking.run(f"""
        carry_out(FetchGoal({goal}))
        result = [client.get_state() == GoalStatus.ABORTED, client.get_goal_status_text()]
        carry_out(FetchGoal(things=0))
        result.append(client.get_state() == GoalStatus.SUCCEEDED)
    """)
    assert aborted
    assert "the goal is impossible" in words
    assert after
