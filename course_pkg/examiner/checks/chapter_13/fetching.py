"""13.1: what an action's server does with a goal: feedback, result, and an ear for a cancellation."""

from __future__ import annotations

import itertools
import statistics
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.hearing import Hearing
from course_pkg.msg import FetchAction, FetchGoal

STATES = {
    value: name for name, value in vars(GoalStatus).items() if name.isupper() and isinstance(value, int)
}
BEGIN = """
from course_pkg.graph.acting import ActionServer
from course_pkg.msg import FetchAction

acting = []

def begin(name, execute):
    acting.append(ActionServer(name, FetchAction, execute))

def end():
    acting.pop().stop()
"""
EACH = 0.1  # s that one thing takes
PATIENCE = 8.0  # s for an ending that is due after half a second
TRIES = 2  # for a goal of nothing: of some hundred, on a busy machine, one was never heard of again
SLOW = 5.0  # times as long as it should: then it is no longer a busy machine
NOTICING = 3.0  # s to end after a cancellation; one thing takes a tenth
UNSAID = (
    "The function came to its end, and nobody had said how. It returns nothing: it tells the server, by "
    "set_succeeded, set_preempted or set_aborted."
)


@part(
    "13.1",
    points=3,
    goal="Carry out a goal: feedback after each thing, the result at the end, and a stop when asked.",
    needs=["fetch"],
    deadline=60.0,
)
def the_action(exam: Exam) -> None:
    """Serve the student's function as an action; send three goals: one is cancelled, one is of nothing."""
    name = f"/{exam.draw.word()}"
    exam.prepare(BEGIN)
    told = exam.hear(f"{name}/feedback", "course_pkg/FetchActionFeedback")
    begun = exam.run("begin", name, Its("fetch"), worded="the action")
    exam.hold("an action can be served with it", not begun.error, expected="a server", seen=begun.error)
    try:
        client = actionlib.SimpleActionClient(name, FetchAction)
        client.wait_for_server(rospy.Duration(PATIENCE))
        _to_the_end(exam, client, told)
        _cancelled(exam, client, told)
        _nothing(exam, client)
    finally:
        exam.run("end", worded="the action")


def _to_the_end(exam: Exam, client: actionlib.SimpleActionClient, told: Hearing) -> None:
    things = exam.draw.integer(4, 6)
    began = time.monotonic()
    client.send_goal(FetchGoal(things=things, seconds=EACH))
    _ended(exam, client, "a goal is carried out to its end", GoalStatus.SUCCEEDED)
    took = time.monotonic() - began
    told.wait(things, within=3.0)
    exam.expect(
        "the result says how many were fetched",
        expected=things,
        seen=client.get_result().fetched,
        hints={
            0: "A field that nobody fills is 0: set_succeeded(FetchResult(fetched=…)).",
            1: "set_succeeded ends the goal, so it stands behind the loop: once, when all is fetched.",
            things - 1: "range counts from 0: the last number is one less than how many there were.",
        },
    )
    exam.hold(
        "each thing takes its time",
        took > 0.9 * things * EACH,
        expected=f"some {things * EACH:.1f} s for {things} things",
        seen=f"{took:.2f} s",
        hints="Sleep for goal.seconds with each thing.",
    )
    _in_its_time(exam, told, began)
    counts = _counts(told)
    exam.expect(
        "after each thing the feedback says how many there are by now",
        expected=list(range(1, things + 1)),
        seen=counts,
        hints=[
            ([], "No feedback was sent: server.publish_feedback(FetchFeedback(fetched=…)) after each thing."),
            (list(range(things)), "When the first thing is there, it is 1: range counts from 0."),
            ([things], "It came only at the end. Send it in the loop, after each thing."),
            (lambda seen: not any(seen), "A field that nobody fills is 0: FetchFeedback(fetched=…)."),
        ],
    )
    exam.hold(
        "the feedback comes while the goal is carried out",
        told.arrivals[-1].at - told.arrivals[0].at > 0.4 * things * EACH,
        expected="one after the other",
        seen="all at the same moment",
        hints="Whoever waits wants to know now. Send each as soon as the thing is there.",
    )


def _in_its_time(exam: Exam, told: Hearing, began: float) -> None:
    """Hold that each feedback comes when its thing is there: not before, and not much later."""
    at = [arrival.at for arrival in told.arrivals]
    if at and at[0] - began < 0.9 * EACH:
        exam.fail(
            "the feedback comes when the thing is there",
            expected=f"the first after {EACH:g} s",
            seen=f"the first after {at[0] - began:.2f} s",
            hint="It was told of before it was fetched. Sleep for goal.seconds first, and publish then.",
        )
    gaps = [after - before for before, after in itertools.pairwise(at)]
    if gaps and statistics.median(gaps) > SLOW * EACH:
        exam.fail(
            "each thing takes its time",
            expected=f"{EACH:g} s for each thing, as the goal says",
            seen=f"{statistics.median(gaps):.1f} s",
            hint="Sleep for goal.seconds with each thing, and for nothing else.",
        )


def _cancelled(exam: Exam, client: actionlib.SimpleActionClient, told: Hearing) -> None:
    before = told.count
    client.send_goal(FetchGoal(things=80, seconds=EACH))
    told.wait(before + 3, within=PATIENCE)
    client.cancel_goal()
    over = client.wait_for_result(rospy.Duration(NOTICING))
    exam.hold(
        "a goal that is cancelled ends soon",
        over,
        expected="an end after the thing that is under way",
        seen="a robot that goes on fetching",
        hints="Look before each thing whether server.is_preempt_requested(), and stop then.",
    )
    _ended(exam, client, "a goal that is cancelled ends as PREEMPTED", GoalStatus.PREEMPTED)
    last = _last(told)
    exam.expect(
        "its result says how many were fetched until then",
        expected=last,
        seen=client.get_result().fetched,
        hints=[
            (0, "A field that nobody fills is 0: set_preempted(FetchResult(fetched=…))."),
            (80, "That is what was asked for. Say how many there were."),
            (
                lambda seen: seen < last,
                "It went on fetching. set_preempted ends the goal, and not your function: return after it.",
            ),
            (says(""), "As many as the last feedback said."),
        ],
    )


def _nothing(exam: Exam, client: actionlib.SimpleActionClient) -> None:
    for _ in range(TRIES):
        client.send_goal(FetchGoal(things=0, seconds=EACH))
        if client.wait_for_result(rospy.Duration(PATIENCE / TRIES)):
            break
    _ended(
        exam,
        client,
        "a goal of 0 things is done at once, also after one that was cancelled",
        GoalStatus.SUCCEEDED,
    )


def _ended(exam: Exam, client: actionlib.SimpleActionClient, rule: str, state: int) -> None:
    over = client.wait_for_result(rospy.Duration(PATIENCE))
    seen = STATES.get(client.get_state(), "?") if over else "no end"
    text = client.get_goal_status_text()
    exam.hold(
        rule,
        over and client.get_state() == state,
        expected=STATES[state],
        seen=f"{seen}: {text}" if text else seen,
        hints=[
            (says("No terminal state"), UNSAID),
            (says("Exception in execute callback"), "An error in the function ended it. Read what it says."),
            (
                says("^SUCCEEDED"),
                "It was called off, and did not succeed: server.set_preempted(…), and return.",
            ),
            (says("^PREEMPTED"), "Nobody asked it to stop. When all is fetched, server.set_succeeded(…)."),
            (
                says("^ABORTED"),
                "set_aborted is for a robot that could not. This one was called off: set_preempted.",
            ),
            (says("no end"), "Does the loop end, and does the server hear of it by set_succeeded?"),
        ],
    )


def _counts(told: Hearing) -> list[int]:
    return [arrival.fields["feedback"]["fetched"] for arrival in told.arrivals]


def _last(told: Hearing) -> int:
    """Return the last count that was told, when no more comes."""
    told.during(0.3)
    return _counts(told)[-1]
