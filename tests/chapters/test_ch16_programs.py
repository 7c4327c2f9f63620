"""The programs of chapter 16: the bridge to programs without ROS, and the robot that fetches things."""

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
    """The server of chapter 05."""
    with NodeProcess(["rosrun", "course_pkg", "server"]) as process:
        process.wait_for_service("/getGeometry")
        yield process


@pytest.fixture
def bridge() -> Iterator[NodeProcess]:
    """`rosrun course_pkg bridge _port:=0`, listening."""
    with NodeProcess(["rosrun", "course_pkg", "bridge", "_port:=0"]) as process:
        process.wait_for_output("ws://", timeout=20)
        yield process


@pytest.fixture
def line(bridge: NodeProcess) -> Iterator[websocket.WebSocket]:
    """A connection to it."""
    found = re.search(r"ws://\S+\d", bridge.output())
    assert found
    connection = websocket.create_connection(found[0], timeout=20)
    yield connection
    connection.close()


def said(line: websocket.WebSocket, message: JSON) -> dict[str, JSON]:
    """Send one message and return the answer."""
    line.send(message if isinstance(message, str) else json.dumps(message))
    answer: dict[str, JSON] = json.loads(line.recv())
    return answer


def call(service: str, args: JSON, **more: str) -> dict[str, JSON]:
    """Return a message that asks for a call."""
    return {"op": "call_service", "service": service, "args": args, **more}


@pytest.mark.parametrize("args", [SIDES, [1.5, 2.0, 3.0]], ids=["by name", "by position"])
def test_a_call_brings_the_fields_of_the_response(
    line: websocket.WebSocket, geometry: NodeProcess, args: object
) -> None:
    """The answer names the service, has the id that was given, and says that all went well."""
    assert said(line, call("/getGeometry", args, id="mine")) == {
        "op": "service_response",
        "id": "mine",
        "service": "/getGeometry",
        "values": {"area": 3.0, "volume": 9.0},
        "result": True,
    }


@pytest.mark.parametrize(
    ("service", "args", "words"),
    [
        ("/getGeometry", {"length": -1.0}, "cannot process request: length is -1"),
        ("/getGeometry", {"hieght": 1.0}, "No field name"),
        ("/getGeometry", [1.0], "Not enough arguments"),
        ("/getGeometry", "a text", "neither an object"),
        ("/getGeometry", 5, "neither an object"),
        ("/getGeometry", {"length": "long"}, "length"),
        ("/nobody", {}, "not available"),
    ],
)
def test_a_call_that_fails_says_why_and_the_bridge_goes_on(
    line: websocket.WebSocket, geometry: NodeProcess, service: str, args: object, words: str
) -> None:
    """The result is false, and the values are the words of the error."""
    answer = said(line, call(service, args))
    assert answer["result"] is False
    assert words in answer["values"]
    assert said(line, call("/getGeometry", SIDES))["result"] is True


@pytest.mark.parametrize("message", ["no JSON", "[]", "7", {"op": "publish"}, {"op": "call_service"}])
def test_what_is_no_call_gets_a_status(line: websocket.WebSocket, message: object) -> None:
    """The protocol has a status for that, with a level and words."""
    answer = said(line, message)
    assert (answer["op"], answer["level"]) == ("status", "error")


def test_nested_fields_come_as_objects(line: websocket.WebSocket) -> None:
    """Messages within messages are objects within objects."""
    loggers = said(line, call("/bridge/get_loggers", {}))["values"]["loggers"]
    assert {"name", "level"} == set(loggers[0])


def test_it_ends_at_once_with_a_connection_open(line: websocket.WebSocket, bridge: NodeProcess) -> None:
    """Ctrl-C ends it by itself, with nothing printed but its address, and the port is free."""
    bridge.interrupt()
    assert bridge.wait() == 0
    assert "Traceback" not in bridge.output()


def test_it_listens_on_this_computer_alone(bridge: NodeProcess) -> None:
    """Nobody from outside can call services through it."""
    port = int(bridge.output().rpartition(":")[2].split()[0])
    assert port in listening_ports(bridge.pid)
    with open("/proc/net/tcp") as table:
        addresses = [row.split()[1] for row in table if row.split()[1].endswith(f":{port:04X}")]
    assert addresses[0].startswith("0100007F")


def test_a_port_that_is_taken_is_said(bridge: NodeProcess) -> None:
    """Exit status 1, and what to type instead."""
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
    """A kernel with a client, and the robot."""
    with NodeProcess(["rosrun", "course_pkg", "fetcher"]):
        kernel.run(FETCHING)
        yield kernel


def test_a_goal_is_carried_out_with_feedback(asking: Kernel) -> None:
    """As many things as were asked for, and a word after each of them; the last may come with the result."""
    counts, fetched, succeeded = asking.run("""
        client.send_goal(FetchGoal(things=5, seconds=0.05), feedback_cb=tell)
        assert client.wait_for_result(rospy.Duration(20))
        result = [told, client.get_result().fetched, client.get_state() == GoalStatus.SUCCEEDED]
    """)
    assert counts[:4] == [1, 2, 3, 4]
    assert (fetched, succeeded) == (5, True)


def test_a_goal_that_is_called_off_ends_with_what_there_is(asking: Kernel) -> None:
    """Between two things it notices, and the result says how many there are."""
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
def test_a_goal_that_cannot_be_is_aborted_in_words(asking: Kernel, goal: str) -> None:
    """It is not begun, the words say why, and the robot is there for the next goal."""
    aborted, words, after = asking.run(f"""
        carry_out(FetchGoal({goal}))
        result = [client.get_state() == GoalStatus.ABORTED, client.get_goal_status_text()]
        carry_out(FetchGoal(things=0))
        result.append(client.get_state() == GoalStatus.SUCCEEDED)
    """)
    assert aborted
    assert "no robot fetches" in words
    assert after
