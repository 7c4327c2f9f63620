"""16.1: goals that the check cancels while the student's action server executes them."""

from __future__ import annotations

import time

import actionlib
from actionlib_msgs.msg import GoalStatus

from course_pkg.chapters.ch16_go_further.checks.sent_goals import TIMEOUT, counts, ends_as, is_over, sends
from course_pkg.checking import ANYTHING, CheckContext
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.msg import FetchGoal
from course_pkg.waiting import wait_until

LAST = 0.2  # LAST is the time in s for the last thing; during this time, the check cancels the goal.
CANCELLING = 3.0  # A goal must end within this time in s after its cancellation.


def _wrong_number_left(last: int) -> Hints:
    return [
        (
            0,
            (
                "The field `fetched` is 0 in the result of the cancelled goal. Write "
                "set_preempted(FetchResult(fetched=…))."
            ),
        ),
        (
            80,
            (
                "The result is 80, but this is the number of things in the goal. Return the "
                "number of things that the robot "
                "fetched before the cancellation."
            ),
        ),
        (
            lambda actual: actual < last,
            (
                "The robot continued after set_preempted, because set_preempted does not end your "
                "function. Return from the function after this call."
            ),
        ),
        (
            ANYTHING,
            "The result of the cancelled goal is wrong. Return the same number as in the last feedback.",
        ),
    ]


def cancels_a_goal(
    context: CheckContext, client: actionlib.SimpleActionClient, feedback: Subscription
) -> None:
    """Cancel a goal after its second feedback message; the goal must then end as PREEMPTED."""
    before = feedback.count
    sends(context, client, FetchGoal(things=80, seconds=0.1), ", and its cancellation")
    feedback.wait(before + 2, within=TIMEOUT)
    client.cancel_goal()
    context.require(
        "a cancelled goal ends after the current thing",
        holds=is_over(client, CANCELLING),
        expected="a goal that ends after the current thing",
        actual="a robot that continues to fetch",
        hints=(
            "The robot continued after the client had cancelled the goal. Call "
            "is_preempt_requested() before the robot fetches each thing, and end the goal if this "
            "call returns True."
        ),
    )
    ends_as(context, client, "a cancelled goal ends in the state PREEMPTED", GoalStatus.PREEMPTED)
    last = _last(feedback)
    context.expect(
        "the result of a cancelled goal is the number of fetched things",
        expected=last,
        actual=client.get_result().fetched,
        hints=_wrong_number_left(last),
    )


def cancels_during_the_last_thing(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    """Cancel a goal while the robot fetches its last thing; the goal must then end as SUCCEEDED.

    On a busy machine, the cancellation can arrive too early or too late; the check then also accepts a wrong
    server.
    """
    sends(context, client, FetchGoal(things=1, seconds=LAST), ", and its cancellation")
    wait_until(lambda: client.get_state() == GoalStatus.ACTIVE, LAST)
    time.sleep(LAST / 4)  # The server tests for a cancellation only after the goal has become active.
    client.cancel_goal()
    result = client.get_result() if is_over(client, TIMEOUT) else None
    complete = result is not None and result.fetched == 1
    context.require(
        "the server executes a goal to its end",
        holds=not (complete and client.get_state() == GoalStatus.PREEMPTED),
        expected="SUCCEEDED",
        actual="PREEMPTED, after the last thing",
        hints=(
            "The goal was cancelled while the robot fetched the last thing, and it ended as PREEMPTED "
            "although all things were fetched. Check for a cancellation only before the robot fetches a "
            "thing. After the last thing, call set_succeeded without this check."
        ),
    )


def _last(feedback: Subscription) -> int:
    """Wait 0.3 s for late messages, and return the number in the last feedback message."""
    feedback.during(0.3)
    return counts(feedback)[-1]
