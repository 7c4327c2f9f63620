"""16.2: an action client that cancels its goal after a time limit."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import actionlib
import rospy
from actionlib_msgs.msg import GoalID

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.result import Result
from course_pkg.msg import FetchAction, FetchGoal, FetchResult
from course_pkg.ros.node.action_server import ActionServer

WAIT = 2.0  # The client waits up to this time in s for an action server.
LONG = 6.0  # A robot needs this time in s for a goal, and the client cancels this goal.
PROMPT = 4.0  # With a robot that needs 0.3 s, the whole call may take up to this time in s on a busy machine.
ENOUGH = 5.0  # If the robot has to finish in time, the client gets this time limit in s.
BRIEF = 0.2  # If the robot ignores the cancellation, the client gets this time limit in s.
LATE = 0.6  # LATE is the time in s between the call and the start of a late robot.
# The client must cancel the goal after this time in s. The time is not a whole number, so a client that
# rounds the time fails.
SECONDS = 0.8
SLACK = 3.0  # SLACK is the additional time in s that a call may take on a busy machine.
LONGEST = 3.4  # If no robot runs, the fastest of `ATTEMPTS` calls may take up to this time in s.
# If the robot ignores the cancellation, the fastest of `ATTEMPTS` calls may take up to this time in s.
STUBBORN = 3.9
ATTEMPTS = 3
BOUND = (
    "A wait without a time limit did not end. Pass a rospy.Duration above 0 to both wait_for_server "
    "and wait_for_result."
)
DURATION = "actionlib does not accept a plain number of seconds. Pass rospy.Duration(seconds)."
UNSENT = (
    "The server got no goal. Call wait_for_server(rospy.Duration(2)) and then send_goal: a goal that the "
    "client sends before the connection exists is lost."
)
HOW_LONG = "The time limit is wrong. Use the argument `seconds`: wait_for_result(rospy.Duration(seconds))."
NOBODY = (
    "No server started in time, so wait_for_server returned False. In this case, return None and do "
    "not send a goal."
)
ABORTED = (
    "The robot aborted the goal, but the function did not return the number in the result. Return this "
    "number for every final state."
)
EARLY = (
    "There is no result before the goal has ended. After cancel_goal(), wait for the result again, "
    "because the goal ends only after the robot has fetched its current thing."
)


class Robot:
    """An action server that records its goals and cancellations."""

    def __init__(self, fetched: int, seconds: float, *, stubborn: bool = False, aborts: bool = False) -> None:
        self.goals: list[FetchGoal] = []
        self.cancelled = threading.Event()
        self.cancelled_all = False
        self.took = 0.0  # `took` is the time in s from the goal to its cancellation.
        # A stubborn robot ignores a cancellation. The check sets this event to end execute().
        self.over = threading.Event()
        self._fetched, self._seconds = fetched, seconds
        self._stubborn, self._aborts = stubborn, aborts

    def receive_cancel(self, cancelled: GoalID) -> None:
        """Record a message on the topic `cancel`; an empty id means all goals."""
        self.cancelled_all = self.cancelled_all or not cancelled.id

    def execute(self, goal: FetchGoal, server: actionlib.SimpleActionServer) -> None:
        """Finish after the goal's time, or after a cancellation; the result is the same in both cases."""
        self.goals.append(goal)
        began = time.monotonic()
        if self._stubborn:
            self.over.wait(LONG)
            return
        wait, left = threading.Event(), self._seconds
        while left > 0 and not server.is_preempt_requested():
            wait.wait(0.05)
            left -= 0.05
        if server.is_preempt_requested():
            self.took = time.monotonic() - began
            self.cancelled.set()
            wait.wait(0.3)  # The robot first finishes the thing that it is fetching.
            server.set_preempted(FetchResult(fetched=self._fetched))
        elif self._aborts:
            server.set_aborted(FetchResult(fetched=self._fetched))
        else:
            server.set_succeeded(FetchResult(fetched=self._fetched))


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
    _comes(context)
    _nobody(context)


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
    ]


@contextmanager
def _serving(name: str, robot: Robot) -> Iterator[None]:
    """Serve the action `name` until the end of the `with` block; the object `robot` executes the goals."""
    server = ActionServer(name, FetchAction, robot.execute)
    cancellations = rospy.Subscriber(f"{name}/cancel", GoalID, robot.receive_cancel)
    try:
        yield
    finally:
        cancellations.unregister()
        server.stop()


def _in_time(context: CheckContext) -> None:
    name = f"/{context.random.word()}"
    things, fetched = context.random.integer(3, 9), context.random.integer(20, 90)
    robot = Robot(fetched, 0.3)
    with _serving(name, robot):
        result = _fetch(context, robot, name, things, ENOUGH)
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
    name, fetched = f"/{context.random.word()}", context.random.integer(20, 90)
    robot = Robot(fetched, LONG)
    with _serving(name, robot):
        result = _fetch(context, robot, name, 5, SECONDS)
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
        with _serving(name, robot):
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


def _comes(context: CheckContext) -> None:
    """Start a robot while the client waits for the action server; this robot aborts its goal."""
    name, fetched = f"/{context.random.word()}", context.random.integer(20, 90)
    robot = Robot(fetched, 0.1, aborts=True)
    with ExitStack() as ending:

        def serve() -> None:
            ending.callback(ActionServer(name, FetchAction, robot.execute).stop)

        coming = threading.Timer(LATE, serve)
        coming.start()
        try:
            result = _fetch(context, robot, name, 3, ENOUGH)
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


def _nobody(context: CheckContext) -> None:
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


def _fetch(context: CheckContext, robot: Robot, name: str, things: int, seconds: float) -> Result:
    def is_early(_: object) -> bool:
        return robot.cancelled.is_set()

    return context.run(
        "fetch_within",
        name,
        things,
        seconds,
        within=seconds + 5.0,
        hints=[
            (matches("TimesUp"), BOUND),
            (matches("unsupported operand|'float' object|'int' object|Duration"), DURATION),
            ((lambda error: not robot.goals and "NoneType" in error), UNSENT),
            (is_early, EARLY),
            (
                matches("NoneType"),
                (
                    "get_result() returned None, because the goal had not ended. When the time is over, "
                    "call cancel_goal() and wait for the result again."
                ),
            ),
        ],
    )
