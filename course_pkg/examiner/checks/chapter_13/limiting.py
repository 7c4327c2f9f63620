"""13.2: an action's client that waits for so long, and then calls it off."""

from __future__ import annotations

import threading
from typing import Any

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.graph.acting import ActionServer
from course_pkg.msg import FetchAction, FetchResult

NOBODY = 2.0  # s that the client waits for a server
LONG = 8.0  # s of the robot that is called off
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
BOUND = (
    "It waits for what does not come. rospy.Duration(…) bounds a wait, and without one it has no bound: "
    "wait_for_server and wait_for_result both."
)
DURATION = "actionlib takes no plain number of seconds: rospy.Duration(seconds)."
EARLY = (
    "There is no result before the goal has ended. After cancel_goal() wait once more: the robot still "
    "finishes what it has in its hands."
)


class Robot:
    """An action server of the check's own; it remembers its goals and whether it was called off."""

    def __init__(self, fetched: int, seconds: float) -> None:
        self.goals: list[Any] = []
        self.called_off = threading.Event()
        self._fetched, self._seconds = fetched, seconds

    def execute(self, goal: Any, server: Any) -> None:  # noqa: ANN401 -- classes of actionlib
        """Take `seconds`, unless it is called off; the result is what was drawn, in any case."""
        self.goals.append(goal)
        wait, left = threading.Event(), self._seconds
        while left > 0 and not server.is_preempt_requested():
            wait.wait(0.05)
            left -= 0.05
        if server.is_preempt_requested():
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
    """Offer a robot that is done in time, one that is not, and none."""
    _in_time(exam)
    _too_late(exam)
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
        outcome = _asked(exam, robot, name, 5, 1.0)
        if not outcome.error:
            exam.hold(
                "a robot that is not done in time is called off",
                robot.called_off.wait(1.0),
                expected="a cancellation after 1 s",
                seen="a robot that goes on, although nobody waits for it any more",
                hints="When wait_for_result returns False, the time is up: cancel_goal().",
            )
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


def _nobody(exam: Exam) -> None:
    outcome = exam.run(
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
    exam.expect(
        "None where there is no such robot",
        expected=None,
        seen=outcome.value,
        hints=[(says(""), "wait_for_server returns False when nobody came. Return None then.")],
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
            (is_early, EARLY),
            (
                says("NoneType"),
                "There is no result before the goal has ended. When the time is up, call it off by "
                "cancel_goal(), and wait once more.",
            ),
        ],
    )
