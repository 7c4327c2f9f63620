"""16.2: the student's action client without a robot, and with a robot that starts late."""

from __future__ import annotations

import threading
from contextlib import ExitStack

from course_pkg.chapters.ch16_go_further.checks.scripted_robot import (
    ATTEMPTS,
    ENOUGH,
    UNSENT,
    WAIT,
    Robot,
    fetch,
)
from course_pkg.checking import CheckContext, matches
from course_pkg.checking.assertions import Hints
from course_pkg.checking.result import Result
from course_pkg.msg import FetchAction
from course_pkg.ros.node.action_server import ActionServer

LATE = 0.6  # LATE is the time in s between the call and the start of a late robot.
LONGEST = 2.8  # If no robot runs, the fastest of `ATTEMPTS` calls may take up to this time in s.
NOBODY = (
    "No server started in time, so wait_for_server returned False. In this case, return None and do "
    "not send a goal."
)
ABORTED = (
    "The robot aborted the goal, but the function did not return the number in the result. Return this "
    "number for every final state."
)


def starts_late(context: CheckContext) -> None:
    """Start a robot while the client waits for the action server; this robot aborts its goal."""
    name, fetched = f"/{context.random.word()}", context.random.integer(20, 90)
    robot = Robot(fetched, 0.1, aborts=True)
    with ExitStack() as ending:

        def serve() -> None:
            ending.callback(ActionServer(name, FetchAction, robot.execute).stop)

        coming = threading.Timer(LATE, serve)
        coming.start()
        try:
            result = fetch(context, robot, name, 3, ENOUGH)
        finally:
            coming.join()
        if robot.goals:
            context.expect(
                "if the robot finishes in time, fetch_within() returns the result",
                expected=fetched,
                actual=result.returned(),
                hints=ABORTED,
            )
        if result.returned() != fetched:
            too_short = (
                f"The server started {LATE:g} s after the call, but the goal did not arrive. Use "
                "wait_for_server to wait up to 2 s for the server."
            )
            context.fail(
                "a server that starts within 2 s gets the goal",
                expected=str(fetched),
                actual=str(result.returned()),
                # If the call took more time than its time limit `ENOUGH`, the client did not wait for the
                # server. The client sent the goal too early, so the goal was lost.
                hint=UNSENT if result.took > ENOUGH else too_short,
            )


def never_starts(context: CheckContext) -> None:
    """Run the student's function without a robot; it must return None after a wait of 2 s."""
    result = _call_without_robot(context)
    context.expect(
        "fetch_within() returns None if no robot offers the action",
        expected=None,
        actual=result.returned(),
        hints=NOBODY,
    )
    for _ in range(ATTEMPTS - 1):
        if result.took > LONGEST:
            result = _call_without_robot(context)
    if result.took > LONGEST:
        context.fail(
            "fetch_within() returns None if no robot offers the action",
            expected=f"None after {WAIT:g} s",
            actual=f"None after {result.took:.1f} s",
            hint=(
                f"The function waited too long for a server. Pass rospy.Duration({WAIT:g}) to "
                "wait_for_server."
            ),
        )


WAITED_FOR_EVER: Hints = [
    (
        matches("TimesUp"),
        "No server exists, but the function waits without a time limit. Write "
        "wait_for_server(rospy.Duration(2)).",
    ),
    (
        matches("NoneType"),
        NOBODY,
    ),
]


def _call_without_robot(context: CheckContext) -> Result:
    return context.run(
        "fetch_within", f"/{context.random.word()}", 3, 1.0, within=WAIT + 4.0, hints=WAITED_FOR_EVER
    )
