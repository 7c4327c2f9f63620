"""Tests of action servers in a cell that runs again, and after stop()."""

from __future__ import annotations

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from tests.kernel import Kernel

START = """
import actionlib, rospy, time
from course_pkg.ros import join
from course_pkg.ros.node.action_server import ActionServer
from course_pkg.msg import FetchAction, FetchGoal, FetchResult
node = join("acting")

def returning(number):
    return lambda goal, server: server.set_succeeded(FetchResult(fetched=number))

def until_called_off(goal, server):
    while not server.is_preempt_requested():
        time.sleep(0.01)
    server.set_preempted(FetchResult(fetched=7))

def asked(within=10):
    client = actionlib.SimpleActionClient("/fetch", FetchAction)
    assert client.wait_for_server(rospy.Duration(within))
    client.send_goal_and_wait(FetchGoal(things=1), rospy.Duration(within))
    return client.get_result().fetched
"""


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node and has imported an action type."""
    kernel.run(START)
    return kernel


def test_a_goal_is_executed(joined: Kernel) -> None:
    """The client of the action receives the result of the server's function."""
    assert joined.run('server = ActionServer("/fetch", FetchAction, returning(3))\nresult = asked()') == 3


def test_serving_again_replaces(joined: Kernel, master: PrivateMaster) -> None:
    """If the cell runs again, only the new function executes goals."""
    joined.run('server = ActionServer("/fetch", FetchAction, returning(1))')
    joined.run('server = ActionServer("/fetch", FetchAction, returning(2))')
    assert joined.run("result = [asked(), asked()]") == [2, 2]


def test_a_failing_function_aborts_only_its_goal(joined: Kernel) -> None:
    """If the function raises an error or sets no result, the goal is aborted."""
    assert joined.run("""
        def failing(goal, server):
            if goal.things:
                1 / 0
        server = ActionServer("/fetch", FetchAction, failing)
        client = actionlib.SimpleActionClient("/fetch", FetchAction)
        assert client.wait_for_server(rospy.Duration(10))
        result = []
        for things in (1, 0):
            client.send_goal_and_wait(FetchGoal(things=things), rospy.Duration(10))
            result.append((client.get_state() == actionlib.GoalStatus.ABORTED, client.get_goal_status_text()))
    """) == [
        [True, "Exception in execute callback: division by zero"],
        [True, "The function ended without a final state."],
    ]


def test_a_kernel_with_an_action_ends_by_itself(master: PrivateMaster) -> None:
    """When a kernel with an action server exits normally, the action's topics are unregistered."""
    with Kernel() as kernel:
        kernel.run(START)
        kernel.run('server = ActionServer("/fetch", FetchAction, until_called_off)')
    assert "/fetch/status" not in MasterClient(master.uri).system_state().publishers


def test_stop_removes_the_action_from_the_graph(joined: Kernel, master: PrivateMaster) -> None:
    """stop() unregisters the topics of the action, and cancels the running goal."""
    joined.run("""
        server = ActionServer("/fetch", FetchAction, until_called_off)
        client = actionlib.SimpleActionClient("/fetch", FetchAction)
        assert client.wait_for_server(rospy.Duration(10))
        client.send_goal(FetchGoal(things=1))
        deadline = time.monotonic() + 10
        while client.get_state() != actionlib.GoalStatus.ACTIVE and time.monotonic() < deadline:
            time.sleep(0.01)
        client.stop_tracking_goal()
    """)
    assert "/fetch/status" in MasterClient(master.uri).system_state().publishers
    assert (
        joined.run("""
        thread = server._thread
        server.stop()
        server.stop()
        result = thread.is_alive()
    """)
        is False
    )
    assert "/fetch/status" not in MasterClient(master.uri).system_state().publishers
