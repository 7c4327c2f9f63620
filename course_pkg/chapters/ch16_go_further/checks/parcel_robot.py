"""16.4: a whole node with a topic, a service, an action and a parameter.

The student decides for each name whether it is a topic, a service or an action.
"""

from __future__ import annotations

import itertools
import statistics
import time

import actionlib
import rospy
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus

from course_pkg.chapters.ch16_go_further.checks.robot_program import (
    FILE,
    Robot,
    offers_what_fits,
    started,
)
from course_pkg.chapters.ch16_go_further.checks.sent_goals import STATES
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.msg import FetchAction, FetchGoal
from course_pkg.waiting import wait_until

USUAL = 5  # Without an argument, the robot has the capacity for this many parcels.
MORE = 7  # The first robot has the capacity for this many parcels, which is more than the default.
PARCELS = 3  # Each delivery has this many parcels, which both robots can carry.
EACH = 0.2  # A robot needs this time in s for one parcel.
SLOWER = (0.55, 0.9)  # In a cancelled delivery, the time in s for one parcel is between these two limits.
PERIOD = 0.2  # The robot publishes the charge of its battery every `PERIOD` s.
LATEST = 8  # The check measures the period with up to this many of the latest values.
STEADY = 3.0  # On a busy machine, the period must be right within this time in s.
LONG = 2.5  # In the last goal, which has too many parcels, each parcel would need this time in s.
ENDING = 4.0  # ENDING is the time limit in s for the end of a goal.
SETTLING = 1.0  # After a delivery, the right charge must be published within this time in s.
NOT_AT_ONCE = 0.9  # A goal that took at least this fraction of its full time was not aborted immediately.

START = f"""%%writefile {FILE}
#!/usr/bin/env python3
# A robot that delivers parcels: battery, door, deliver and capacity.
import rospy


if __name__ == "__main__":
    rospy.init_node("parcel_robot")
    # Write your node: imports above, functions or a class above this block, the rest here.
"""
NOT_SUCCEEDED = (
    "The delivery did not end in the state SUCCEEDED. Call set_succeeded at the end of the delivery."
)
DELIVERED = "Deliver parcels with feedback, and publish the charge of the battery."
STOPPED = "Stop when a client cancels the delivery."
LIMITED = "Refuse a delivery of more parcels than the parameter ~capacity allows."


@part(
    "16.4",
    points=4,
    goal=(
        "Write a node with four interfaces: battery, door, deliver and capacity. For each interface, "
        "choose a topic, a service, an action or a parameter."
    ),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals=[DELIVERED, STOPPED, LIMITED, "Open and close the door."],
)
def parcel_robot(context: CheckContext) -> None:
    """Start a robot with the argument capacity, and a robot without this argument; use both robots."""
    folder = context.folder(files=[FILE])
    with started(context, folder, f"_capacity:={MORE}") as first, started(context, folder) as second:
        battery = context.subscribe(first.name("battery"), "std_msgs/Float32")
        offers_what_fits(context, first)
        _starts_with_a_full_battery(context, battery)
        feedback = context.subscribe(first.name("deliver/feedback"), "course_pkg/FetchActionFeedback")
        client = _client(first)
        feedback.published()
        _delivers(context, client, feedback, battery)
        charge = _delivers_one_more(context, client, battery)
        context.fulfilled(DELIVERED)
        charge = _cancels(context, client, feedback, battery, charge)
        context.fulfilled(STOPPED)
        _refuses_too_many(context, client, MORE)
        _delivers_nothing_impossible(context, battery, charge - MORE)
        offers_what_fits(context, second)
        _refuses_too_many(context, _client(second), USUAL)
        context.fulfilled(LIMITED)
        _moves_the_door(context, first)


def _client(robot: Robot) -> actionlib.SimpleActionClient:
    client = actionlib.SimpleActionClient(robot.name("deliver"), FetchAction)
    client.wait_for_server(rospy.Duration(ENDING))
    return client


def _starts_with_a_full_battery(context: CheckContext, battery: Subscription) -> None:
    battery.published()
    battery.wait(4, within=3.0)
    steady = wait_until(lambda: 0.75 * PERIOD < _period(battery) < 1.2 * PERIOD, STEADY, PERIOD)
    period = _period(battery)
    context.require(
        "the node publishes five values of the battery per second",
        holds=steady,
        expected=f"a value every {PERIOD:g} s",
        actual=f"a value every {period:.2f} s" if period else "too few values",
        hints=(
            "The battery does not publish five values per second. Publish in a loop that calls sleep() "
            "of a rospy.Rate(5) in each round."
        ),
    )
    context.expect(
        "the first value of the battery is 100",
        expected=100.0,
        actual=battery.arrivals[0].fields["data"],
        hints="Before the first delivery, the charge has to be 100. Publish the charge in percent.",
    )


def _period(battery: Subscription) -> float:
    """Return the median time in s between two of the latest values, or 0 if there is only one value."""
    latest = battery.arrivals[-LATEST:]
    gaps = [after.at - before.at for before, after in itertools.pairwise(latest)]
    return statistics.median(gaps) if gaps else 0.0


def _moves_the_door(context: CheckContext, robot: Robot) -> None:
    door = context.service(robot.name("door"), "std_srvs/SetBool")
    for wanted, position in ((True, "open"), (False, "closed"), (True, "open"), (True, "open")):
        response = door(data=wanted)
        context.expect(
            "the response of door contains the new position",
            expected=position,
            actual=response.message,
            hints=(
                'The field `message` is wrong. Set it to "open" after a request with True, and to '
                '"closed" after a request with False.'
            ),
        )
        context.expect(
            "in the response of door, `success` is True",
            expected=True,
            actual=response.success,
            hints=(
                "The field `success` is False, although the robot has moved the door. Set this "
                "field to True after each request."
            ),
        )


def _delivers(
    context: CheckContext, client: actionlib.SimpleActionClient, feedback: Subscription, battery: Subscription
) -> None:
    before = battery.count
    client.send_goal(FetchGoal(things=PARCELS, seconds=EACH))
    _ends_as(context, client, "a delivery succeeds", GoalStatus.SUCCEEDED, NOT_SUCCEEDED)
    meanwhile = battery.count - before
    feedback.wait(PARCELS, SETTLING)
    context.expect(
        "the node publishes feedback after each parcel",
        expected=[1, 2, 3],
        actual=_counts(feedback),
        hints="The feedback is wrong. After each parcel, publish the number of delivered parcels: 1, 2, 3.",
    )
    context.expect(
        "the result is the number of delivered parcels",
        expected=PARCELS,
        actual=client.get_result().fetched,
        hints=(
            "The result is wrong. Call set_succeeded(FetchResult(fetched=…)) with the number of "
            "delivered parcels."
        ),
    )
    context.require(
        "the node continues to publish the battery during a delivery",
        holds=meanwhile >= 2,
        expected=f"about {PARCELS * EACH / PERIOD:.0f} values",
        actual=meanwhile,
        hints=(
            "The node published no charge during the delivery. Deliver the parcels in the function "
            "of the action, and publish the charge in another thread."
        ),
    )
    _reduces_the_charge(
        context,
        battery,
        100.0 - PARCELS,
        [
            (100.0, "The charge did not change. Subtract 1 from the charge after each delivered parcel."),
            (
                99.0,
                (
                    "The charge changed only once during the whole delivery. Subtract 1 from the charge "
                    "after each parcel."
                ),
            ),
        ],
    )


def _delivers_one_more(
    context: CheckContext, client: actionlib.SimpleActionClient, battery: Subscription
) -> float:
    """Let the robot deliver one more parcel; return the charge of the battery afterwards."""
    client.send_goal(FetchGoal(things=1, seconds=0.0))
    _ends_as(context, client, "a delivery succeeds", GoalStatus.SUCCEEDED, NOT_SUCCEEDED)
    charge = 100.0 - PARCELS - 1
    _reduces_the_charge(
        context,
        battery,
        charge,
        "After a second delivery, the charge was wrong. Set the charge to 100 only at the start of the "
        "program.",
    )
    return charge


def _reduces_the_charge(context: CheckContext, battery: Subscription, charge: float, hints: Hints) -> None:
    """Wait for the value `charge` of the battery (in percent), and assert that it is the last value."""
    battery.until(lambda arrivals: arrivals[-1].fields["data"] == charge, SETTLING)
    context.expect(
        "each delivered parcel reduces the charge by 1 percent",
        expected=charge,
        actual=battery.arrivals[-1].fields["data"],
        hints=hints,
    )


def _counts(feedback: Subscription) -> list[int]:
    return [arrival.fields["feedback"]["fetched"] for arrival in feedback.arrivals]


def _cancels(
    context: CheckContext,
    client: actionlib.SimpleActionClient,
    feedback: Subscription,
    battery: Subscription,
    before_it: float,
) -> float:
    """Cancel a delivery after its first parcel; return the charge of the battery afterwards.

    `before_it` is the charge before this delivery.
    """
    before = feedback.count
    each = context.random.number(*SLOWER)
    began = time.monotonic()
    client.send_goal(FetchGoal(things=PARCELS, seconds=each))
    feedback.wait(before + 1, ENDING)
    took = time.monotonic() - began
    client.cancel_goal()
    _ends_as(
        context,
        client,
        "a delivery can be cancelled",
        GoalStatus.PREEMPTED,
        (
            "A cancelled delivery did not end in the state PREEMPTED. Check "
            "is_preempt_requested() before each parcel, and end the goal with set_preempted."
        ),
    )
    context.require(
        "each parcel takes the time in the field `seconds` of the goal",
        holds=took > NOT_AT_ONCE * each,
        expected=f"the first parcel after {each:.2f} s",
        actual=f"the first parcel after {took:.2f} s",
        hints=(
            "The first parcel took less time than the goal requires. For each parcel, sleep for "
            "goal.seconds, because each goal contains its own time."
        ),
    )
    feedback.until(lambda _: _counts(feedback)[-1] == client.get_result().fetched, SETTLING)
    context.expect(
        "a cancelled delivery returns the number of delivered parcels",
        expected=_counts(feedback)[-1],
        actual=client.get_result().fetched,
        hints=(
            "The result of a cancelled delivery is wrong. Call "
            "set_preempted(FetchResult(fetched=…)) with the number of delivered parcels."
        ),
    )
    charge = before_it - int(client.get_result().fetched)
    _reduces_the_charge(
        context,
        battery,
        charge,
        [
            (
                before_it,
                (
                    "The charge did not change for the parcels of a cancelled delivery. Subtract 1 "
                    "immediately after each delivered parcel."
                ),
            ),
            (
                ANYTHING,
                (
                    "The charge changed for parcels that were not delivered. Subtract 1 only after each "
                    "delivered parcel."
                ),
            ),
        ],
    )
    return charge


def _delivers_nothing_impossible(context: CheckContext, battery: Subscription, charge: float) -> None:
    """Assert that a goal with too many parcels did not change the charge."""
    battery.until(lambda arrivals: arrivals[-1].fields["data"] == charge, SETTLING)
    battery.during(3 * PERIOD)  # Wait for further messages, because a wrong charge may follow.
    context.expect(
        "an aborted delivery delivers no parcels",
        expected=f"a charge of {charge:g}",
        actual=f"a charge of {battery.arrivals[-1].fields['data']:g}",
        hints=(
            "The function continued after set_aborted, because set_aborted does not end your "
            "function. Return from the function after this call."
        ),
    )


def _refuses_too_many(context: CheckContext, client: actionlib.SimpleActionClient, capacity: int) -> None:
    """Send a goal with one parcel too many, and a goal with the highest possible number of parcels."""
    _aborts_at_once(context, client, capacity, EACH)
    context.expect(
        "an aborted delivery delivers no parcels",
        expected=0,
        actual=client.get_result().fetched,
        hints=[
            (
                ANYTHING,
                (
                    "The robot delivered no parcel, so the result has to be 0. Pass "
                    "FetchResult(fetched=0) to set_aborted."
                ),
            )
        ],
    )
    # A function that does not return after set_aborted would deliver a parcel in this time.
    time.sleep(2 * EACH)
    client.send_goal(FetchGoal(things=capacity, seconds=0.0))
    _ends_as(
        context,
        client,
        "a delivery succeeds if the number of parcels is equal to the capacity",
        GoalStatus.SUCCEEDED,
        (
            "The robot refused an allowed delivery. Abort a goal only if it has more parcels than the "
            "parameter ~capacity (default: 5)."
        ),
    )
    _aborts_at_once(context, client, capacity, LONG)


def _aborts_at_once(
    context: CheckContext, client: actionlib.SimpleActionClient, capacity: int, each: float
) -> None:
    """Send a goal with one parcel too many; the goal must be aborted immediately.

    `each` is the time in s for each parcel.
    """
    began = time.monotonic()
    client.send_goal(FetchGoal(things=capacity + 1, seconds=each))
    _ends_as(
        context,
        client,
        "the robot aborts a delivery if the number of parcels is above the capacity",
        GoalStatus.ABORTED,
        (
            "The delivery was not aborted, although it has more parcels than the capacity. Compare "
            "goal.things with the parameter ~capacity (default: 5), and call set_aborted."
        ),
    )
    took = time.monotonic() - began
    context.require(
        "a delivery of too many parcels ends immediately",
        holds=took < NOT_AT_ONCE * min(each * capacity, LONG),
        expected="a goal that ends before the first parcel",
        actual=f"a goal that ended after {took:.1f} s",
        hints="The goal ended too late. Compare goal.things with the capacity before the loop.",
    )


def _ends_as(
    context: CheckContext, client: actionlib.SimpleActionClient, assertion: str, state: int, hint: str
) -> None:
    """Assert that the goal ends with the status `state`.

    If the student's function raised an exception, report the exception first.
    """
    handle = client.gh
    assert handle is not None
    over = wait_until(lambda: handle.get_comm_state() == CommState.DONE, ENDING)
    text = client.get_goal_status_text()
    seen = STATES.get(client.get_state(), "?") if over else "no end"
    context.require(
        assertion,
        holds=over and client.get_state() == state,
        expected=STATES[state],
        actual=f"{seen}: {text}" if text else seen,
        hints=[
            (
                (lambda _: "Exception" in text),
                (
                    "The function that delivers the parcels raised an exception. Read the error "
                    "message above, and "
                    "correct the error."
                ),
            ),
            (ANYTHING, hint),
        ],
    )
