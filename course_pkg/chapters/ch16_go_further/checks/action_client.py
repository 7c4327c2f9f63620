"""16.2: an action client that cancels its goal after a time limit."""

from __future__ import annotations

from typing import NoReturn

from course_pkg.chapters.ch16_go_further.checks.scripted_robot import (
    ATTEMPTS,
    ENOUGH,
    FEEDBACK,
    LONG,
    UNSENT,
    WAIT,
    Robot,
    fetch,
    serving,
)
from course_pkg.chapters.ch16_go_further.checks.server_wait import never_starts, starts_late
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.msg import FetchGoal

PROMPT = 4.0  # With a robot that needs 0.3 s, the whole call may take up to this time in s on a busy machine.
BRIEF = 0.2  # If the robot ignores the cancellation, the client gets this time limit in s.
# The client must cancel the goal after this time in s. The time is not a whole number, so a client that
# rounds the time fails.
SECONDS = 0.8
SLACK = 3.0  # SLACK is the additional time in s that a call may take on a busy machine.
# The fastest of `ATTEMPTS` cancellations may come up to this time in s after the time limit.
LATE = 0.6
# If the robot ignores the cancellation, the fastest of `ATTEMPTS` calls may take up to this time in s.
STUBBORN = 3.9
HOW_LONG = "The time limit is wrong. Use the argument `seconds`: wait_for_result(rospy.Duration(seconds))."

FETCHED = "Send a goal, and return the number of fetched things."
CANCELLED = "Cancel the goal when the time limit is over, and return the number of fetched things."


@part(
    "16.2",
    points=3,
    goal=(
        "Send a goal, and wait for the result with a time limit. When the time limit is over, "
        "cancel the goal. Return the number of fetched things."
    ),
    needs=["fetch_within"],
    deadline=60.0,
    goals=[FETCHED, CANCELLED, "Wait at most 2 s for the action server."],
)
def bounded_goal(context: CheckContext) -> None:
    """Run the student's function without a robot, and with robots that behave differently."""
    _in_time(context)
    context.fulfilled(FETCHED)
    _too_late(context)
    _goes_on(context)
    context.fulfilled(CANCELLED)
    starts_late(context)
    never_starts(context)


def _wrong_result(robot: Robot, things: int) -> Hints:
    return [
        ((lambda _: not robot.goals), UNSENT),
        (None, NO_RETURN),
        (
            things,
            (
                "The function returned the field `things` of the goal. Return the number in the result: "
                "get_result().fetched."
            ),
        ),
        (
            lambda actual: isinstance(actual, dict),
            "The function returned the whole result. Return only its field `fetched`.",
        ),
        (
            lambda actual: actual in (0, FEEDBACK),
            "The function returned the number of the feedback, or 0. Wait for the result, and return "
            "get_result().fetched.",
        ),
    ]


def _in_time(context: CheckContext) -> None:
    name = f"/{context.random.word()}"
    things, fetched = context.random.integer(3, 9), context.random.integer(20, 90)
    robot = Robot(fetched, 0.3)
    with serving(name, robot):
        result = fetch(context, robot, name, things, ENOUGH)
        context.expect(
            "if the robot finishes in time, fetch_within() returns the result",
            expected=fetched,
            actual=result.returned(),
            hints=_wrong_result(robot, things),
        )
        context.require(
            "if the robot finishes in time, fetch_within() returns the result",
            holds=result.took < PROMPT,
            expected="a function that returns the result as soon as it arrives",
            actual=f"a function that returned the result after {result.took:.1f} s",
            hints=(
                "The function still waited after the result had arrived. Remove sleep(), because "
                "wait_for_result returns as soon as the goal has ended."
            ),
        )
    _sends_the_goal(context, robot.goals[0], things)
    context.require(
        "fetch_within() does not cancel a goal that ends in time",
        holds=not robot.cancelled.is_set(),
        expected="no cancellation",
        actual="a cancellation",
        hints=HOW_LONG,
    )


def _sends_the_goal(context: CheckContext, goal: FetchGoal, things: int) -> None:
    context.expect(
        "the goal contains the number of things",
        expected=things,
        actual=goal.things,
        hints=[(0, "The field `things` of the goal is 0. Set this field: FetchGoal(things=…, seconds=0.1).")],
    )
    context.expect(
        "the goal contains the time for each thing",
        expected=0.1,
        actual=goal.seconds,
        near=1e-6,
        hints=(
            "The field `seconds` of the goal is not 0.1. Set this field: FetchGoal(things=…, seconds=0.1)."
        ),
    )


def _too_late(context: CheckContext) -> None:
    """Let the time limit pass; repeat the call if the cancellation comes late, because of a busy machine."""
    for _ in range(ATTEMPTS):
        robot = _exceeds_the_limit(context)
        if robot.took < SECONDS + LATE:
            return
    _cancels_at_a_wrong_time(context, robot)


def _exceeds_the_limit(context: CheckContext) -> Robot:
    """Call the student's function with a robot that needs too long; return this robot."""
    name, fetched = f"/{context.random.word()}", context.random.integer(20, 90)
    robot = Robot(fetched, LONG)
    with serving(name, robot):
        result = fetch(context, robot, name, 5, SECONDS)
        if not result.error:
            _is_cancelled(context, robot)
            context.require(
                "fetch_within() cancels a goal that does not end in time",
                holds=not robot.cancelled_all,
                expected="a cancellation of this goal",
                actual="a cancellation of all goals",
                hints="cancel_all_goals() also cancels the goals of other clients. Call cancel_goal().",
            )
        context.expect(
            "after a cancellation, fetch_within() returns the number of fetched things",
            expected=fetched,
            actual=result.returned(),
            hints=[
                (
                    0,
                    (
                        "The function read the result before the goal had ended. Wait for the result "
                        "again after cancel_goal()."
                    ),
                ),
                (
                    None,
                    (
                        "The function returned None. After cancel_goal(), wait for the result again, and "
                        "return the number for every final state, not only for SUCCEEDED."
                    ),
                ),
            ],
        )
    return robot


def _is_cancelled(context: CheckContext, robot: Robot) -> None:
    context.require(
        "fetch_within() cancels a goal that does not end in time",
        holds=robot.cancelled.wait(1.0),
        expected=f"a cancellation after {SECONDS:g} s",
        actual="no cancellation: the robot continues although the client has stopped waiting",
        hints=[
            ((lambda _: not robot.goals), UNSENT),
            (
                ANYTHING,
                (
                    "The function did not cancel the goal. Call cancel_goal() if wait_for_result returns "
                    "False, which means that the time limit is over."
                ),
            ),
        ],
    )
    if not 0.6 * SECONDS < robot.took < SECONDS + SLACK:
        _cancels_at_a_wrong_time(context, robot)


def _cancels_at_a_wrong_time(context: CheckContext, robot: Robot) -> NoReturn:
    context.fail(
        "fetch_within() cancels a goal that does not end in time",
        expected=f"a cancellation after {SECONDS:g} s",
        actual=f"a cancellation after {robot.took:.1f} s",
        hint=HOW_LONG,
    )


def _goes_on(context: CheckContext) -> None:
    """Start a robot that ignores cancellations; the student's function must end with a value or an error."""
    for _ in range(ATTEMPTS):
        name = f"/{context.random.word()}"
        robot = Robot(0, LONG, stubborn=True)
        with serving(name, robot):
            result = context.run("fetch_within", name, 3, BRIEF, within=BRIEF + WAIT + SLACK)
            robot.over.set()
        endless = result.error.startswith("TimesUp")
        if endless or result.took < STUBBORN:
            break
    context.require(
        "fetch_within() cancels a goal that does not end in time",
        holds=not endless and result.took < STUBBORN,
        expected=f"a function that ends at most {WAIT:g} s after the cancellation",
        actual="a function that does not end"
        if endless
        else (f"a function that ended after {result.took:.1f} s"),
        hints=(
            "The robot ignored the cancellation, so the function waited too long. Wait at most 2 s "
            "after cancel_goal()."
        ),
    )
