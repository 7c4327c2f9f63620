"""15.6: a node that waits for customers and greets them, and mirrors the arm at the same time."""

from __future__ import annotations

import itertools
import re
import time

from course_pkg.chapters.ch15_robot_cashier.checks.mirror import ARM, DETECT, MIRRORED, NAME, RESET
from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, program, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.peers.joint_states import JOINTS
from course_pkg.chapters.ch15_robot_cashier.checks.peers.scripted_visits import (
    STANDING,
    STEPS,
    VISITS_END,
    Alone,
    Call,
    Detector,
    Till,
    described,
)
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, complete, examined, started
from course_pkg.checking import CheckContext, part
from course_pkg.checking.commands.folder import Running, telling_line
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.plain_values import Fields
from course_pkg.waiting import wait_until

GREETINGS = "greetings"
INTERFACE = Interface(publishes=[MIRRORED, GREETINGS], subscribes=[ARM])
AWAIT = "course_pkg/AwaitCustomer"
TRIGGER = "std_srvs/Trigger"
STRING = "std_msgs/String"
GREETING = "Good day!"
VALID: Fields = {"name": ["a"], "position": [0.1]}
INVALID: Fields = {"name": ["b"], "position": []}
# The measured pause must be between these limits (s); the exercise requires 0.5 s, and the machine may be
# busy.
PAUSE, TOO_LONG = 0.4, 2.0
# While a customer is there, the time in s between two calls is at least BETWEEN; the shortest of these times
# is at most AT_MOST.
BETWEEN, AT_MOST = 0.18, 0.6
NEXT_CALL = 6.0  # NEXT_CALL is the time limit in s for the next call on a busy machine.
NO_CALL = (
    "No call arrived. In the main thread, call detect_customer in a loop until rospy.is_shutdown() "
    "returns True."
)
GIVEN_UP = (
    "The node made no call after a failed call. Catch rospy.ServiceException, wait 0.5 s, and call the "
    "service again."
)
DIED = (
    "After a failed call, the node ended with an error that is not a rospy.ServiceException. If the proxy "
    "has persistent=True, remove this argument."
)
CALLED_ONCE = (
    "The node called the service only once. Call the service in a loop: while not rospy.is_shutdown()."
)
RESET_FAILED = (
    "A call of till/reset failed, and the node then stopped calling detect_customer. Catch "
    "rospy.ServiceException at the call of till/reset, and continue the loop."
)
NO_TILL = (
    "The service till/reset does not exist, and the node stopped calling detect_customer. If the node "
    "waits for till/reset, use a time limit, and catch rospy.ServiceException."
)
NO_DEFAULT = (
    "If the parameter ~wait is not set, the field `patience` has to be 2 s. Use "
    'rospy.get_param("~wait", 2.0).'
)
PARAMETER = (
    'The field `patience` has a wrong value. Read the private parameter "~wait" of the node: '
    'rospy.get_param("~wait", 2.0).'
)
STILL_THERE = (
    "In the last response, `found` was True, so a customer is there. Set the field `patience` of "
    "the next call to 0."
)
VISIT_GOES_ON = (
    "A failed call does not end a visit. After the failure, call detect_customer again with "
    "`patience` 0, until `found` is False."
)
VISIT_OVER = (
    "In the last response, `found` was False, so no customer is there. Set the field `patience` of "
    "the next call to the value of ~wait, even if till/reset fails."
)
HASTY = "The next call came too early. While a customer is there, wait 0.2 s between two calls."
SLOW = (
    "The next calls came too late. While a customer is there, wait only 0.2 s between two calls, and not "
    "longer."
)
NO_PAUSE = (
    "The node made the next call immediately after a failed call. Wait 0.5 s before the next call, "
    "for example with rospy.sleep(0.5)."
)
LONG_PAUSE = "After a failed call, the next call came too late. Wait only 0.5 s."
HUNG_UP = (
    "The node made a second call before it got the first response. Wait for each response, even if "
    "this takes several seconds."
)
NOT_GREETED = (
    'A customer came, but the node sent no greeting. Publish on the topic "greetings" when `found` is True.'
)
GREETED_LATE = (
    "The greeting came at the end of the visit. Publish the greeting at the beginning of the visit, as soon "
    "as `found` is True."
)
OTHER_IMAGE = (
    "A mirror image is wrong, or it belongs to an invalid joint state. Copy the callback of exercise 15.5 "
    "without a change."
)
GREETED_AGAIN = (
    "The node published more than one greeting in a visit. Publish only once, at the beginning of a visit."
)
NOT_FOUND = (
    "`found` was False, but the node acted as if a customer was there. Test the field `found`: in "
    "an if statement, a response object always counts as true."
)
TEXT = "The text of the greeting is wrong. Compare this text with the text in the exercise, letter by letter."
NO_RESET = "The visit is over, but the node did not call till/reset. Call this service when `found` is False."
EARLY_RESET = (
    "The node called till/reset before the visit had ended. Call this service when `found` is False."
)
RESETS = "The node called till/reset more than once after a visit. Call this service once after each visit."
STANDS_STILL = (
    "The node publishes no mirror image while it waits for the response of detect_customer. Make "
    "the call in the main thread, and "
    "publish in the callback of the subscriber."
)
GREETED = "Greet each customer once, and publish mirror images of the arm at the same time."


@part(
    "15.6",
    points=3,
    goal=(
        "Extend robot_cashier.py: wait for customers and greet each customer once. At the same "
        "time, publish mirror images of the arm."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME, "# Copy your program of exercise 15.5 into this cell, and extend the copy.\n..."),
    goals={
        GREETED: 3,
        "Call detect_customer in a loop. If the parameter ~wait is not set, set `patience` to 2 s.": 1,
    },
)
def the_visits(context: CheckContext) -> None:
    """Run a detector that responds, refuses and closes a connection, and a till that refuses once."""
    package = examined(context, NAME)
    names = [*INTERFACE.names, DETECT, RESET]
    space, other = (f"/{context.random.word()}" for _ in range(2))
    wait = context.random.number(2.5, 9.0, digits=1)
    detector = Detector(wait)
    till = Till(detector)
    with (
        started(package, NAME, space, names, {"wait": wait}) as running,
        started(package, NAME, other, names) as default,
    ):
        complete(context, running, program(NAME), space, INTERFACE)
        greetings = context.subscribe(f"{space}/{GREETINGS}", STRING)
        mirrored = context.subscribe(f"{space}/{MIRRORED}", JOINTS)
        greetings.published()
        mirrored.published()
        context.publish(f"{space}/{ARM}", JOINTS, [VALID, INVALID], every=0.025)
        context.serve(f"{space}/{RESET}", TRIGGER, till.answer)
        context.serve(f"{space}/{DETECT}", AWAIT, detector.answer)
        alone = Alone()
        context.serve(f"{other}/{DETECT}", AWAIT, alone.answer)
        _makes_the_calls(context, running, detector, mirrored)
        _greets(context, greetings, till, detector.calls)
        _mirrors_only_valid_states(context, mirrored)
        context.fulfilled(GREETED)
        wait_until(lambda: alone.patiences or default.status is not None, NEXT_CALL)
        context.expect(
            "without the parameter, the field `patience` is 2 s",
            expected=[2.0],
            actual=alone.patiences[:1],
            near=1e-6,
            hints=NO_DEFAULT,
        )
        wait_until(lambda: len(alone.patiences) > 2 or default.status is not None, NEXT_CALL)
        context.require(
            "the node calls detect_customer in a loop",
            holds=len(alone.patiences) > 2,
            expected="a call after the end of a visit, also if the service till/reset does not exist",
            actual="no call",
            hints=NO_TILL,
        )


def _called(running: Running, detector: Detector, times: int) -> bool:
    """Return whether the detector receives `times` calls in total, the last of them within `NEXT_CALL` s."""
    wait_until(lambda: len(detector.calls) >= times or running.status is not None, NEXT_CALL)
    return len(detector.calls) >= times


def _makes_the_calls(
    context: CheckContext, running: Running, detector: Detector, mirrored: Subscription
) -> None:
    """Wait for the calls in `STEPS` in order, and check the `patience` and the time of each call."""
    for number, step in enumerate(STEPS):
        came = _called(running, detector, number + 1)
        before = STEPS[number - 1].name if number else "nothing"
        after = f"after {described(before)}" if number else "in the first call"
        error = "" if came or running.status is None else telling_line(running.stop().out)
        context.require(
            "the node calls detect_customer in a loop",
            holds=came,
            expected=f"a call {after}" if number else "a call",
            actual=f"no call; the node ended with {error}" if error else "no call",
            hints=_why_no_call(number, before, error),
        )
        call = detector.calls[number]
        context.require(
            "the node waits for each response before the next call",
            holds=not number or call.came > detector.calls[number - 1].answered - 0.05,
            expected="one call at a time",
            actual="a second call",
            hints=HUNG_UP,
        )
        wanted = detector.wait if step.waits else 0.0
        context.require(
            "the field `patience` is the value of ~wait, and 0 during a visit",
            holds=abs(call.patience - wanted) < 1e-3,
            expected=f"`patience` {wanted:g} {after}",
            actual=f"`patience` {call.patience:g}",
            hints=_wrong_patience(number, call.patience, wanted),
        )
        if number == 0:
            _mirrors_meanwhile(context, mirrored, call)
    _mirrors_in_visit(context, mirrored, detector.calls)
    _pauses(context, detector.calls)


def _why_no_call(number: int, before: str, error: str) -> str:
    """Return the hint for a missing call; `before` is the result of the previous call.

    If the node has ended, `error` is the last error message in its output.
    """
    if not number:
        return NO_CALL
    if number == len(STEPS) - 1:
        return RESET_FAILED
    if before in ("True", "False"):
        return CALLED_ONCE
    return DIED if re.search("Error|Exception", error) and "ServiceException" not in error else GIVEN_UP


def _wrong_patience(number: int, patience: float, wanted: float) -> str:
    if not number or (wanted and patience):
        return PARAMETER
    if wanted:
        return NOT_FOUND if number == 1 else VISIT_OVER
    return STILL_THERE if STEPS[number - 1].name == "True" else VISIT_GOES_ON


def _mirrors_meanwhile(context: CheckContext, mirrored: Subscription, call: Call) -> None:
    """Count the mirror images that arrive while the first call waits."""
    wait_until(lambda: time.monotonic() > call.answered, STANDING + 1.0)
    meanwhile = [each for each in mirrored.arrivals if call.came + 0.2 < each.at < call.answered]
    context.require(
        "the node mirrors the arm during a call of detect_customer",
        holds=len(meanwhile) > 2,
        expected="an image every 50 ms",
        actual=f"{len(meanwhile)} images in 1 s",
        hints=STANDS_STILL,
    )


def _mirrors_in_visit(context: CheckContext, mirrored: Subscription, calls: list[Call]) -> None:
    """Count the mirror images that arrive during the first visit."""
    began, ended = calls[1].answered + 0.2, calls[VISITS_END[0] - 1].came
    meanwhile = [each for each in mirrored.arrivals if began < each.at < ended]
    context.require(
        "the node mirrors the arm during a call of detect_customer",
        holds=len(meanwhile) > 2,
        expected="an image every 50 ms during a visit, too",
        actual=f"{len(meanwhile)} images during a visit",
        hints=(
            "During a visit, the node published no mirror images. Publish each mirror image in "
            "the callback, even during a visit."
        ),
    )


def _mirrors_only_valid_states(context: CheckContext, mirrored: Subscription) -> None:
    images = [(each.fields["name"], each.fields["position"]) for each in mirrored.arrivals]
    wrong = [image for image in images if image != (VALID["name"], [-0.1])]
    context.require(
        "the node mirrors only valid joint states",
        holds=not wrong,
        expected="images with the name a and the position -0.1",
        actual=f"an image with the names {wrong[0][0]} and the positions {wrong[0][1]}" if wrong else "",
        hints=OTHER_IMAGE,
    )


def _pauses(context: CheckContext, calls: list[Call]) -> None:
    for (before, after), step in zip(itertools.pairwise(calls), STEPS, strict=False):
        pause = after.came - before.answered
        if step.name in ("True", "False"):
            context.require(
                "during a visit, the node waits 0.2 s between two calls",
                holds=step.name == "False" or pause > BETWEEN,
                expected="a pause of 0.2 s",
                actual=f"a pause of {pause:.2f} s",
                hints=HASTY,
            )
        else:
            context.require(
                "after a failed call, the node waits 0.5 s",
                holds=PAUSE < pause < TOO_LONG,
                expected="a pause of 0.5 s",
                actual=f"a pause of {pause:.1f} s",
                hints=NO_PAUSE if pause < PAUSE else LONG_PAUSE,
            )
    shortest = min(
        after.came - before.answered
        for (before, after), step in zip(itertools.pairwise(calls), STEPS, strict=False)
        if step.name == "True"
    )
    context.require(
        "during a visit, the node waits 0.2 s between two calls",
        holds=shortest < AT_MOST,
        expected="a pause of 0.2 s",
        actual=f"pauses of at least {shortest:.2f} s",
        hints=SLOW,
    )


def _greets(context: CheckContext, greetings: Subscription, till: Till, calls: list[Call]) -> None:
    greetings.wait(2, 1.0)
    texts = [arrival.fields["data"] for arrival in greetings.arrivals]
    context.require(
        "the node greets each customer once",
        holds=len(texts) == 2,
        expected="2 greetings for 2 visits",
        actual=f"{len(texts)} greetings",
        hints=NOT_GREETED if len(texts) < 2 else GREETED_AGAIN,
    )
    context.require(
        "the node greets a customer at the beginning of the visit",
        holds=greetings.arrivals[0].at < calls[VISITS_END[0] - 1].came,
        expected="a greeting before the last call of the visit",
        actual="a greeting after the last call of the visit",
        hints=GREETED_LATE,
    )
    context.expect(f'the greeting is "{GREETING}"', expected=[GREETING] * 2, actual=texts, hints=TEXT)
    context.require(
        "the node resets the till once after each visit",
        holds=till.resets == VISITS_END,
        expected="2 calls of till/reset, each when a visit has ended",
        actual=f"{len(till.resets)} calls",
        hints=_wrong_resets(till.resets),
    )


def _wrong_resets(resets: list[int]) -> str:
    if len(resets) == len(VISITS_END):
        return EARLY_RESET
    return NO_RESET if len(resets) < len(VISITS_END) else RESETS
