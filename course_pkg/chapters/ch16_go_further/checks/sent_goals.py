"""16.1: goals that the check sends to the student's action server."""

from __future__ import annotations

import actionlib
import rospy
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus

from course_pkg.checking import CheckContext, matches
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.msg import FetchGoal
from course_pkg.waiting import at_this_load, wait_until

STATES = {
    value: name for name, value in vars(GoalStatus).items() if name.isupper() and isinstance(value, int)
}
TIMEOUT = 6.0  # TIMEOUT is the time limit in s for a goal that needs less than 1 s.
STARTING = 2.0  # STARTING is the time limit in s for the start of a server.
NO_STATE = (
    "The function returned, but the goal has no end state. Call set_succeeded, set_preempted or "
    "set_aborted of the server: a return value has no effect."
)


def is_served(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    """Assert that the student's action server starts."""
    context.require(
        "Fetcher(name) offers an action of this name",
        holds=client.wait_for_server(rospy.Duration(at_this_load(STARTING))),
        expected="an action server",
        actual="no action server",
        hints=(
            "No action server with the right name was started. Pass `name`, the argument of your "
            "constructor, to SimpleActionServer, and call start() of the server."
        ),
    )


def sends(
    context: CheckContext, client: actionlib.SimpleActionClient, goal: FetchGoal, after: str = ""
) -> None:
    """Send a goal; a report shows the goal, and the text `after`, which says what the check does next."""
    context.under_way(f"a goal with things={goal.things} and seconds={goal.seconds}{after}")
    client.send_goal(goal)


WRONG_STATE: Hints = [
    (matches("No terminal state"), NO_STATE),
    (
        matches("Exception in execute callback"),
        "The function raised an exception. Read the error message above, and correct the error.",
    ),
    (
        matches("^SUCCEEDED"),
        (
            "The client cancelled the goal, so SUCCEEDED is the wrong state. Call set_preempted, and "
            "return from the function."
        ),
    ),
    (
        matches("^ABORTED"),
        (
            "The client cancelled the goal, but the function called set_aborted, which means that the "
            "robot failed. Call set_preempted instead."
        ),
    ),
    (
        matches("no end"),
        "The goal did not end. Check that the loop ends and that the function calls set_succeeded.",
    ),
]


def ends_as(context: CheckContext, client: actionlib.SimpleActionClient, assertion: str, state: int) -> None:
    """Wait for the end of the goal, and assert that its end state is `state`, a value of GoalStatus."""
    over = is_over(client, TIMEOUT)
    seen = STATES.get(client.get_state(), "?") if over else "no end"
    text = client.get_goal_status_text()
    context.require(
        assertion,
        holds=over and client.get_state() == state,
        expected=STATES[state],
        actual=f"{seen}: {text}" if text else seen,
        hints=WRONG_STATE,
    )


def is_over(client: actionlib.SimpleActionClient, timeout: float) -> bool:
    """Return whether the goal ends within `timeout` s.

    The client's method wait_for_result() does not notice the end of a goal that ends before send_goal()
    returns.
    """
    handle = client.gh
    assert handle is not None
    return bool(wait_until(lambda: handle.get_comm_state() == CommState.DONE, timeout))


def counts(feedback: Subscription) -> list[int]:
    """Return the numbers in the feedback messages that have arrived."""
    return [arrival.fields["feedback"]["fetched"] for arrival in feedback.arrivals]
