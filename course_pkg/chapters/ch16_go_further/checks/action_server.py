"""16.1: an action server with feedback, a result and cancellation."""

from __future__ import annotations

import itertools
import statistics
import time

import actionlib
from actionlib_msgs.msg import GoalStatus

from course_pkg.chapters.ch16_go_further.checks.cancelled_goals import (
    cancels_a_goal,
    cancels_during_the_last_thing,
)
from course_pkg.chapters.ch16_go_further.checks.sent_goals import (
    STATES,
    counts,
    ends_as,
    is_over,
    is_served,
    sends,
)
from course_pkg.checking import ANYTHING, CheckContext, Its, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.shared.own_program import require_kernel
from course_pkg.msg import FetchAction, FetchGoal
from course_pkg.waiting import Deadline

BEGIN = """
kept = []

def begin(kind, name):
    kept.append(kind(name))
"""
# The two goals use different ranges of times per thing (s), so a program with a fixed time fails.
QUICK, LONG = (0.03, 0.05), (0.22, 0.3)
# If a goal takes too long, the check repeats this goal for up to this time in s, because a busy machine may
# delay messages.
BUSY = 2.0
BRIEFLY = 4.0  # On a busy machine, a goal that needs 0.01 s may take up to this time in s.
FIXED = (
    "The duration of the robot's work is wrong. Sleep for goal.seconds, because each goal contains its "
    "own time for one thing."
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
    is_served(context, client)
    status = [topic.publishers for topic in context.look().topics if topic.name == f"{name}/status"]
    require_kernel(context, [node for publishers in status for node in publishers])
    _carries_out(context, client, feedback)
    _takes_long_for_a_long_thing(context, client)
    _fetches_many(context, client)
    context.fulfilled(EXECUTED)
    cancels_a_goal(context, client, feedback)
    _fetches_nothing(context, client)
    cancels_during_the_last_thing(context, client)
    _serves_two_names(context, client)


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
        sends(context, client, FetchGoal(things=things, seconds=each))
        ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
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
        actual=counts(feedback)[before:],
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
    sends(context, client, FetchGoal(things=2, seconds=each))
    ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
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
    things = context.random.integer(60, 80)
    sends(context, client, FetchGoal(things=things, seconds=0.001))
    ends_as(context, client, "the server executes a goal to its end", GoalStatus.SUCCEEDED)
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


def _fetches_nothing(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    sends(context, client, FetchGoal(things=0, seconds=0.1))
    ends_as(
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


def _serves_two_names(context: CheckContext, client: actionlib.SimpleActionClient) -> None:
    """Create a second object with another name; the first object must still execute a goal to its end."""
    other = f"/{context.random.word()}"
    context.run("begin", Its("Fetcher"), other, worded="Fetcher(name)").returned()
    sends(context, client, FetchGoal(things=1, seconds=0.01))
    context.require(
        "after the start of a second Fetcher, the first Fetcher still executes a goal",
        holds=is_over(client, BRIEFLY) and client.get_state() == GoalStatus.SUCCEEDED,
        expected="SUCCEEDED",
        actual=STATES.get(client.get_state(), "no end"),
        hints=(
            "The check created a second Fetcher with another name, and then the first Fetcher did not "
            "execute a goal to its end. Store the server in the object (self.server), not in the class or in "
            "a global variable."
        ),
    )
