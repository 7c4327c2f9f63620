"""16.1: an action server with feedback, a result and cancellation."""

from __future__ import annotations

import itertools
import statistics
import time

import actionlib
import rospy
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.shared.own_program import require_kernel
from course_pkg.msg import FetchAction, FetchGoal
from course_pkg.waiting import Deadline, at_this_load, wait_until

STATES = {
    value: name for name, value in vars(GoalStatus).items() if name.isupper() and isinstance(value, int)
}
BEGIN = """
kept = []

def begin(kind, name):
    kept.append(kind(name))
"""
# The two goals use different ranges of times per thing (s), so a program with a fixed time fails.
QUICK, LONG = (0.03, 0.05), (0.22, 0.3)
TIMEOUT = 6.0  # TIMEOUT is the time limit in s for a goal that needs less than 1 s.
# If a goal takes too long, the check repeats this goal for up to this time in s, because a busy machine may
# delay messages.
BUSY = 2.0
LAST = 0.2  # LAST is the time in s for the last thing; during this time, the check cancels the goal.
STARTING = 2.0  # STARTING is the time limit in s for the start of a server.
CANCELLING = 3.0  # A goal must end within this time in s after its cancellation.
FIXED = (
    "The duration of the robot's work is wrong. Sleep for goal.seconds, because each goal contains its "
    "own time for one thing."
)
NO_STATE = (
    "The function returned, but the goal has no end state. Call set_succeeded, set_preempted or "
    "set_aborted of the server: a return value has no effect."
)
COUNTED_ON = (
    "The result also counts the things of the previous goal. At the beginning of each goal, set the "
    "number of fetched things to 0."
)
EXECUTED = "Publish feedback after each thing, and the result at the end."


@part(
    "16.1",
    points=3,
    goal=(
        "Write an action server: it sends feedback after each thing and the result at the end, and a "
        "client can cancel the goal."
    ),
    needs=["Fetcher"],
    deadline=60.0,
    goals={EXECUTED: 2, "Stop when a client cancels the goal, and accept a goal with 0 things.": 1},
)
def executed_goal(context: CheckContext) -> None:
    """Create an object of the student's class; send goals with different times, and cancel one goal."""
    name = f"/{context.random.word()}"
    context.prepare(BEGIN)
    feedback = context.subscribe(f"{name}/feedback", "course_pkg/FetchActionFeedback")
    context.run("begin", Its("Fetcher"), name, worded="Fetcher(name)").returned()
    client = actionlib.SimpleActionClient(name, FetchAction)
    _is_served(context, client)
    status = [topic.publishers for topic in context.look().topics if topic.name == f"{name}/status"]
    require_kernel(context, [node for publishers in status for node in publishers])
    _carries_out(context, client, feedback)
    _takes_long_for_a_long_thing(context, client)
    _fetches_many(context, client)
    context.fulfilled(EXECUTED)
    _cancels(context, client, feedback)
    _fetches_nothing(context, client)
    _cancels_during_the_last_thing(context, client)


def _is_served(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
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


def _sends(
    context: CheckContext, client: actionlib.SimpleActionClient, goal: FetchGoal, after: str = ""
) -> None:
    """Send a goal; a report shows the goal, and the text `after`, which says what the check does next."""
    context.under_way(f"a goal with things={goal.things} and seconds={goal.seconds}{after}")
    client.send_goal(goal)


def _wrong_number_fetched(things: int) -> Hints:
    return [
        (0, "The field `fetched` of the result is 0. Write set_succeeded(FetchResult(fetched=…))."),
        (
            1,
            (
                "The goal ended after the first thing, because set_succeeded ends the goal. Call "
                "set_succeeded only once, after the loop."
            ),
        ),
        (
            things - 1,
            (
                "The result is too small by one, because range() starts at 0. Return the number of "
                "fetched things."
            ),
        ),
        (
            things + 1,
            "The result is too large by one. End the loop when the number of fetched things is "
            "equal to goal.things.",
        ),
    ]


def _wrong_feedback(things: int) -> Hints:
    return [
        ([], "No feedback arrived. Call publish_feedback(FetchFeedback(fetched=…)) after each thing."),
        (
            list(range(things)),
            (
                "The feedback is too small by one, because range() starts at 0. After the first thing, "
                "`fetched` has to be 1."
            ),
        ),
        (
            [things],
            (
                "Only one feedback message arrived, at the end of the goal. Publish feedback in the "
                "loop, after each thing."
            ),
        ),
        (
            lambda actual: not any(actual),
            ("The field `fetched` is 0 in each feedback message. Set this field: FetchFeedback(fetched=…)."),
        ),
    ]


def _carries_out(context: CheckContext, client: actionlib.SimpleActionClient, feedback: Subscription) -> None:
    """Send a quick goal. If the goal takes too long, send it again, because the machine may be busy."""
    things = context.random.integer(3, 4)
    each = context.random.number(*QUICK, digits=3)
    limit = Deadline(BUSY)
    while True:
        before, began = feedback.count, time.monotonic()
        _sends(context, client, FetchGoal(things=things, seconds=each))
        _ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
        took = time.monotonic() - began
        feedback.wait(before + things, within=1.0)
        at = [arrival.at for arrival in feedback.arrivals[before:]]
        if _pace(at, took / things) < LONG[0] / 2 or limit.passed:
            break
    context.expect(
        "the result is the number of fetched things",
        expected=things,
        actual=client.get_result().fetched,
        hints=_wrong_number_fetched(things),
    )
    context.require(
        "each thing takes the time in the field `seconds` of the goal",
        holds=took > 0.9 * things * each and _pace(at, took / things) < LONG[0] / 2,
        expected=f"about {things * each:.2f} s for {things} things",
        actual=f"{took:.2f} s",
        hints="The goal ended too early. Sleep for goal.seconds before you publish each feedback message."
        if took < 0.9 * things * each
        else FIXED,
    )
    _sends_feedback(context, feedback, before, things)
    _is_on_time(context, at, began, each)


def _pace(at: list[float], alone: float) -> float:
    """Return the median time between two messages in s; return `alone` if there is only one message."""
    gaps = [after - before for before, after in itertools.pairwise(at)]
    return statistics.median(gaps) if gaps else alone


def _sends_feedback(context: CheckContext, feedback: Subscription, before: int, things: int) -> None:
    context.expect(
        "after each thing, the feedback is the number of fetched things",
        expected=list(range(1, things + 1)),
        actual=_counts(feedback)[before:],
        hints=_wrong_feedback(things),
    )


def _is_on_time(context: CheckContext, at: list[float], began: float, each: float) -> None:
    """Assert that each feedback message arrives when the robot has fetched one more thing."""
    context.require(
        "the feedback arrives during the execution of the goal",
        holds=at[-1] - at[0] > 0.4 * (len(at) - 1) * each,
        expected="one message after the other",
        actual="all messages at the same moment",
        hints=(
            "All feedback messages arrived at the end. Publish each message immediately after the "
            "robot has fetched the thing."
        ),
    )
    context.require(
        "the feedback arrives after the server has fetched the thing",
        holds=at[0] - began > 0.9 * each,
        expected=f"the first feedback after {each:.2f} s",
        actual=f"the first feedback after {at[0] - began:.3f} s",
        hints="The feedback came before the robot had fetched the thing. First sleep, and then publish.",
    )


def _takes_long_for_a_long_thing(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    each = context.random.number(*LONG, digits=3)
    began = time.monotonic()
    _sends(context, client, FetchGoal(things=2, seconds=each))
    _ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
    took = time.monotonic() - began
    context.require(
        "each thing takes the time in the field `seconds` of the goal",
        holds=took > 1.9 * each,
        expected=f"about {2 * each:.2f} s for 2 things",
        actual=f"{took:.2f} s",
        hints=FIXED,
    )
    context.expect(
        "the result is the number of fetched things",
        expected=2,
        actual=client.get_result().fetched,
        hints=COUNTED_ON,
    )


def _fetches_many(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    """Send a goal with a random number of things that the robot fetches quickly."""
    things = context.random.integer(30, 50)
    _sends(context, client, FetchGoal(things=things, seconds=0.001))
    _ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
    context.expect(
        "the result is the number of fetched things",
        expected=things,
        actual=client.get_result().fetched,
        hints=[
            (
                lambda actual: actual < things,
                (
                    "The robot stopped before it had fetched all things. The field goal.things "
                    "contains the number of things. Fetch this number of things."
                ),
            ),
            (ANYTHING, COUNTED_ON),
        ],
    )


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


def _cancels(context: CheckContext, client: actionlib.SimpleActionClient, feedback: Subscription) -> None:
    before = feedback.count
    _sends(context, client, FetchGoal(things=80, seconds=0.1), ", and its cancellation")
    feedback.wait(before + 2, within=TIMEOUT)
    client.cancel_goal()
    context.require(
        "a cancelled goal ends after the current thing",
        holds=_is_over(client, CANCELLING),
        expected="a goal that ends after the current thing",
        actual="a robot that continues to fetch",
        hints=(
            "The robot continued after the client had cancelled the goal. Call "
            "is_preempt_requested() before the robot fetches each thing, and end the goal if this "
            "call returns True."
        ),
    )
    _ends_as(context, client, "a cancelled goal ends in the state PREEMPTED", GoalStatus.PREEMPTED)
    last = _last(feedback)
    context.expect(
        "the result of a cancelled goal is the number of fetched things",
        expected=last,
        actual=client.get_result().fetched,
        hints=_wrong_number_left(last),
    )


def _fetches_nothing(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    _sends(context, client, FetchGoal(things=0, seconds=0.1))
    _ends_as(
        context,
        client,
        "a goal with 0 things ends immediately, even after a cancelled goal",
        GoalStatus.SUCCEEDED,
    )
    context.expect(
        "the result is the number of fetched things",
        expected=0,
        actual=client.get_result().fetched,
        hints=COUNTED_ON,
    )


def _cancels_during_the_last_thing(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    """Cancel a goal while the robot fetches its last thing; the goal must then end as SUCCEEDED.

    On a busy machine, the cancellation can arrive too early or too late; the check then also accepts a wrong
    server.
    """
    _sends(context, client, FetchGoal(things=1, seconds=LAST), ", and its cancellation")
    wait_until(lambda: client.get_state() == GoalStatus.ACTIVE, LAST)
    time.sleep(LAST / 4)  # The server tests for a cancellation only after the goal has become active.
    client.cancel_goal()
    result = client.get_result() if _is_over(client, TIMEOUT) else None
    complete = result is not None and result.fetched == 1
    context.require(
        "the server executes a goal to its end",
        holds=not (complete and client.get_state() == GoalStatus.PREEMPTED),
        expected="SUCCEEDED",
        actual="PREEMPTED, after the last thing",
        hints=(
            "The goal was cancelled while the robot fetched the last thing, and it ended as PREEMPTED "
            "although all things were fetched. Call set_succeeded after the last thing, and check for a "
            "cancellation only before each thing."
        ),
    )


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


def _ends_as(context: CheckContext, client: actionlib.SimpleActionClient, assertion: str, state: int) -> None:
    over = _is_over(client, TIMEOUT)
    seen = STATES.get(client.get_state(), "?") if over else "no end"
    text = client.get_goal_status_text()
    context.require(
        assertion,
        holds=over and client.get_state() == state,
        expected=STATES[state],
        actual=f"{seen}: {text}" if text else seen,
        hints=WRONG_STATE,
    )


def _is_over(client: actionlib.SimpleActionClient, timeout: float) -> bool:
    """Return whether the goal ends within `timeout` s.

    The client's method wait_for_result() does not notice the end of a goal that ends before send_goal()
    returns.
    """
    handle = client.gh
    assert handle is not None
    return bool(wait_until(lambda: handle.get_comm_state() == CommState.DONE, timeout))


def _counts(feedback: Subscription) -> list[int]:
    return [arrival.fields["feedback"]["fetched"] for arrival in feedback.arrivals]


def _last(feedback: Subscription) -> int:
    """Wait 0.3 s for late messages, and return the number in the last feedback message."""
    feedback.during(0.3)
    return _counts(feedback)[-1]
