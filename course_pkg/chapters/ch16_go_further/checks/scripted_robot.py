"""16.2: the robot that the check plays for the student's action client."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import actionlib
import rospy
from actionlib_msgs.msg import GoalID

from course_pkg.checking import CheckContext, matches
from course_pkg.checking.result import Result
from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult
from course_pkg.ros.node.action_server import ActionServer

FEEDBACK = 1  # This number is in the feedback of the robot; it differs from the numbers of goals and results.
WAIT = 2.0  # The client waits up to this time in s for an action server.
LONG = 6.0  # A robot needs this time in s for a goal, and the client cancels this goal.
ENOUGH = 5.0  # If the robot has to finish in time, the client gets this time limit in s.
ATTEMPTS = 3  # If a call takes too long, the check repeats it until it has made this many calls.
BOUND = (
    "A wait without a time limit did not end. Pass a rospy.Duration above 0 to both wait_for_server "
    "and wait_for_result."
)
DURATION = "actionlib does not accept a plain number of seconds. Pass rospy.Duration(seconds)."
UNSENT = (
    "The server got no goal. Call wait_for_server(rospy.Duration(2)) and then send_goal: a goal that the "
    "client sends before the connection exists is lost."
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
        server.publish_feedback(FetchFeedback(fetched=FEEDBACK))
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


@contextmanager
def serving(name: str, robot: Robot) -> Iterator[None]:
    """Serve the action `name` until the end of the `with` block; the object `robot` executes the goals."""
    server = ActionServer(name, FetchAction, robot.execute)
    cancellations = rospy.Subscriber(f"{name}/cancel", GoalID, robot.receive_cancel)
    try:
        yield
    finally:
        cancellations.unregister()
        server.stop()


def fetch(context: CheckContext, robot: Robot, name: str, things: int, seconds: float) -> Result:
    """Run the student's function with an action server of the name `name`, which `robot` executes."""

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
