"""13.2: an action's client that waits for so long, and then calls it off."""

from __future__ import annotations

import threading
import time
from contextlib import ExitStack
from typing import Any

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.graph.acting import ActionServer
from course_pkg.msg import FetchAction, FetchResult

NOBODY = 2.0  # s that the client waits for a server
LONG = 8.0  # s of the robot that is called off
LATE = 0.4  # s after the call until a robot comes
SECONDS = 1.0  # s that the client is to wait for the robot that is called off
SLACK = 3.0  # s: a busy machine is no mistake
TRIES = 2  # for a wait in vain: one who waits too long does so each time
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
BOUND = (
    "It waits for what does not come. rospy.Duration(…) bounds a wait, and without one it has no bound: "
    "wait_for_server and wait_for_result both."
)
DURATION = "actionlib takes no plain number of seconds: rospy.Duration(seconds)."
UNSENT = (
    "The goal never arrived: what is sent before the connection stands is lost. Wait for the robot by "
    "wait_for_server(rospy.Duration(2)) before send_goal."
)
EARLY = (
    "There is no result before the goal has ended. After cancel_goal() wait once more: the robot still "
    "finishes what it has in its hands."
)


class Robot:
    """An action server of the check's own; it remembers its goals and whether it was called off."""

    def __init__(self, fetched: int, seconds: float) -> None:
        self.goals: list[Any] = []
        self.called_off = threading.Event()
        self.took = 0.0  # s from the goal to its cancellation
        self._fetched, self._seconds = fetched, seconds

    def execute(self, goal: Any, server: Any) -> None:  # noqa: ANN401 -- classes of actionlib
        """Take `seconds`, unless it is called off; the result is what was drawn, in any case."""
        self.goals.append(goal)
        began = time.monotonic()
        wait, left = threading.Event(), self._seconds
        while left > 0 and not server.is_preempt_requested():
            wait.wait(0.05)
            left -= 0.05
        if server.is_preempt_requested():
            self.took = time.monotonic() - began
            self.called_off.set()
            wait.wait(0.3)  # what it has in its hands
            server.set_preempted(FetchResult(fetched=self._fetched))
        else:
            server.set_succeeded(FetchResult(fetched=self._fetched))


@part(
    "13.2",
    points=3,
    goal="Send a goal, wait for so long, call it off if need be, and return how many were fetched.",
    needs=["fetch_within"],
    deadline=60.0,
)
def the_client(exam: Exam) -> None:
    """Offer a robot that is done in time, one that is not, one that comes a moment later, and none."""
    _in_time(exam)
    _too_late(exam)
    _comes(exam)
    _nobody(exam)


def _in_time(exam: Exam) -> None:
    name, things, fetched = f"/{exam.draw.word()}", exam.draw.integer(3, 9), exam.draw.integer(20, 90)
    robot = Robot(fetched, 0.3)
    server = ActionServer(name, FetchAction, robot.execute)
    try:
        outcome = _asked(exam, robot, name, things, 5.0)
        exam.expect(
            "a robot that is done in time: its result is returned",
            expected=fetched,
            seen=outcome.value,
            hints=[
                ((lambda _: not robot.goals), UNSENT),
                (None, NO_RETURN),
                (
                    things,
                    "That is how many were asked for. The robot says how many it has: get_result().fetched.",
                ),
                (lambda seen: isinstance(seen, dict), "That is the whole result. Return its field fetched."),
                (
                    lambda seen: isinstance(seen, bool),
                    "wait_for_result says whether it is over. get_result() has the rest.",
                ),
            ],
        )
    finally:
        server.stop()
    exam.expect(
        "the goal says how many things are to be fetched",
        expected=things,
        seen=robot.goals[0].things,
        hints={0: "A field that nobody fills is 0: FetchGoal(things=…, seconds=0.1)."},
    )
    exam.expect(
        "the goal says how many things are to be fetched",
        expected=0.1,
        seen=robot.goals[0].seconds,
        near=1e-6,
        hints="And how long each takes: FetchGoal(things=…, seconds=0.1).",
    )
    exam.hold(
        "a robot that is done in time is not called off",
        not robot.called_off.is_set(),
        expected="no cancellation",
        seen="a cancellation",
        hints="Cancel only when wait_for_result has returned False.",
    )


def _too_late(exam: Exam) -> None:
    name, fetched = f"/{exam.draw.word()}", exam.draw.integer(20, 90)
    robot = Robot(fetched, LONG)
    server = ActionServer(name, FetchAction, robot.execute)
    try:
        outcome = _asked(exam, robot, name, 5, SECONDS)
        if not outcome.error:
            exam.hold(
                "a robot that is not done in time is called off",
                robot.called_off.wait(1.0),
                expected="a cancellation after 1 s",
                seen="a robot that goes on, although nobody waits for it any more",
                hints=[
                    ((lambda _: not robot.goals), UNSENT),
                    (says(""), "When wait_for_result returns False, the time is up: cancel_goal()."),
                ],
            )
            _after_so_many_seconds(exam, robot)
        exam.expect(
            "what it had fetched by then is returned",
            expected=fetched,
            seen=outcome.value,
            hints=[
                (None, "The robot says how many it had, as its result. Wait for that after cancel_goal()."),
                (says(""), "get_result().fetched, once the goal has ended."),
            ],
        )
    finally:
        server.stop()


def _after_so_many_seconds(exam: Exam, robot: Robot) -> None:
    if not 0.6 * SECONDS < robot.took < SECONDS + SLACK:
        exam.fail(
            "a robot that is not done in time is called off",
            expected=f"a cancellation after {SECONDS:g} s",
            seen=f"one after {robot.took:.1f} s",
            hint="Whoever calls it says how long to wait: wait_for_result(rospy.Duration(seconds)).",
        )


def _comes(exam: Exam) -> None:
    """Have a robot come when the client is waiting for it."""
    name, fetched = f"/{exam.draw.word()}", exam.draw.integer(20, 90)
    robot = Robot(fetched, 0.1)
    with ExitStack() as ending:

        def serve() -> None:
            ending.callback(ActionServer(name, FetchAction, robot.execute).stop)

        coming = threading.Timer(LATE, serve)
        coming.start()
        try:
            outcome = _asked(exam, robot, name, 3, 5.0)
        finally:
            coming.join()
        if outcome.value != fetched:
            exam.fail(
                "a robot that comes within 2 s is waited for",
                expected=str(fetched),
                seen=str(outcome.value),
                hint=f"The robot came {LATE:g} s after the call: wait_for_server(rospy.Duration(2)).",
            )


def _nobody(exam: Exam) -> None:
    for _ in range(TRIES):
        outcome = _in_vain(exam)
        if outcome.took < 2 * NOBODY:
            break
    exam.expect(
        "None where there is no such robot",
        expected=None,
        seen=outcome.value,
        hints=[(says(""), "wait_for_server returns False when nobody came. Return None then.")],
    )
    if outcome.took > 2 * NOBODY:
        exam.fail(
            "None where there is no such robot",
            expected=f"None after {NOBODY:g} s",
            seen=f"None after {outcome.took:.1f} s",
            hint=f"It waited for too long: wait_for_server(rospy.Duration({NOBODY:g})).",
        )


def _in_vain(exam: Exam) -> Outcome:
    """Ask for a robot that does not come."""
    return exam.run(
        "fetch_within",
        f"/{exam.draw.word()}",
        3,
        1.0,
        within=NOBODY + 4.0,
        hints=[
            (says("TimesUp"), "Nobody serves it, and it waits for ever: wait_for_server(rospy.Duration(2))."),
            (
                says("NoneType"),
                "wait_for_server returns False when nobody came. Return None then, before anything is sent.",
            ),
        ],
    )


def _asked(exam: Exam, robot: Robot, name: str, things: int, seconds: float) -> Outcome:
    def is_early(_: object) -> bool:
        return robot.called_off.is_set()

    return exam.run(
        "fetch_within",
        name,
        things,
        seconds,
        within=seconds + 5.0,
        hints=[
            (says("TimesUp"), BOUND),
            (says("unsupported operand|'float' object|'int' object|Duration"), DURATION),
            ((lambda _: not robot.goals), UNSENT),
            (is_early, EARLY),
            (
                says("NoneType"),
                "There is no result before the goal has ended. When the time is up, call it off by "
                "cancel_goal(), and wait once more.",
            ),
        ],
    )
