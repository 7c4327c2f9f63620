"""The robot that fetches things, as an action."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.graph import NodeProcess
from tests.kernel import Kernel

START = """
import actionlib, rospy, threading
from actionlib import GoalStatus
from course_pkg.graph import join
from course_pkg.msg import FetchAction, FetchGoal
node = join("asking")
client = actionlib.SimpleActionClient("/fetch", FetchAction)
assert client.wait_for_server(rospy.Duration(20))
told, third = [], threading.Event()

def tell(feedback):
    told.append(feedback.fetched)
    if feedback.fetched == 3:
        third.set()
"""


@pytest.fixture
def asking(kernel: Kernel) -> Iterator[Kernel]:
    """A kernel with a client, and the robot."""
    with NodeProcess(["rosrun", "course_pkg", "fetcher"]):
        kernel.run(START)
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
        client.send_goal_and_wait(FetchGoal({goal}), rospy.Duration(20))
        result = [client.get_state() == GoalStatus.ABORTED, client.get_goal_status_text()]
        client.send_goal_and_wait(FetchGoal(things=0), rospy.Duration(20))
        result.append(client.get_state() == GoalStatus.SUCCEEDED)
    """)
    assert aborted
    assert "no robot fetches" in words
    assert after
