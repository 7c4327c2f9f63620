"""15.2 and 15.3: a service that waits for a customer for a limited time.

The service refuses calls if the camera is silent.
"""

from __future__ import annotations

import math
import time
from concurrent.futures import Future, ThreadPoolExecutor

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.peers.seen_customers import SeenCustomers
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import BUG, refused
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, student_node
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import REFUSED_BY_HANDLER
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.plain_values import Message

NAME = "customer_detector"
SEEN, DETECT = "customer_seen", "detect_customer"
INTERFACE = Interface(services=[DETECT], subscribes=[SEEN])
AWAIT = "course_pkg/AwaitCustomer"
LONG = 6.0  # This value of `patience` (s) is longer than every successful wait.
LATER = 2.2  # LATER is the time in s until a customer comes.
SLACK = 2.0  # SLACK is the additional time in s that a call may take on a busy machine.
EARLY = 0.1  # A call may end up to `EARLY` s before the right time, because the measured times are not exact.
CALLERS = 9  # This many calls wait at the same time; each call begins `APART` s after the previous call.
APART = 0.06
BEGUN = 0.6  # All calls have begun after this time in s.
SOONER = 1.0  # In a repeated attempt, the customer comes after this time in s.
ATTEMPTS = 6
# In the best attempt, each response has to come within this time in s after the customer. With pauses of 0.25
# s between two polls, the last response comes later.
PROMPT = 0.16

NOT_SEEN = (
    "The newest message reports a customer, but `found` is False in the response. Use the newest message."
)
REMEMBERED = (
    "The newest message reports no customer, but `found` is True in the response. Use only the "
    "newest message, and no older message."
)
NO_WAIT = (
    "The response came too early. If no customer is there, wait for request.patience seconds in total: use "
    "`wait_for`, because each message ends a call of `wait()`."
)
TOO_LONG = (
    "The response came too late. Wait for request.patience seconds in total: use `wait_for`, because each "
    "message starts the time limit of `wait()` again."
)
ONE_BY_ONE = (
    "One call had to wait for another call. Do not hold a lock while the handler waits "
    "(Condition.wait_for releases its lock during the wait)."
)
NOT_WOKEN = (
    "The customer came while several calls were waiting, but one of these calls ended too late. "
    "In the callback, call notify_all() to wake up all waiting calls."
)
POLLED = (
    "A call got its response late, because the handler polls with long pauses. Wait with "
    "Condition.wait_for, and call notify_all() in the callback of the subscriber."
)
UNREFUSED = (
    "The handler accepted an impossible value of `patience`. Raise rospy.ServiceException if the "
    "value is below 0 or above 60 s."
)
NAN = (
    "The handler accepted nan (not a number), because each comparison with nan is False. Write `if not "
    "0 <= request.patience <= 60`."
)
NAMELESS = 'The error message does not contain the word "patience". Write this word into the message.'
FIRST = (
    "The handler waited before it refused the call. Check request.patience at the beginning of the handler."
)

FAILED: Hints = [
    (
        REFUSED_BY_HANDLER,
        (
            "The handler refused a valid call. If messages arrive on customer_seen, accept every value of "
            "`patience` from 0 to 60 s."
        ),
    ),
    (matches("error processing"), BUG),
    (matches("TimesUp"), TOO_LONG),
]
WAITED = "Wait for a customer, but for at most `patience` seconds."
SEVERAL = "Respond to several clients at the same time."
SILENT_CAMERA = "Refuse a call if no message has arrived yet, or if no message arrived in the last second."


@part(
    "15.2",
    points=3,
    goal=(
        "Write customer_detector.py: detect_customer waits for a customer, but for at most "
        "`patience` seconds."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME),
    goals={WAITED: 3, SEVERAL: 2, "Refuse an impossible value of `patience`.": 1},
)
def the_detector(context: CheckContext) -> None:
    """Call the detector with a customer, without a customer, and several times at the same time."""
    with student_node(context, NAME, INTERFACE) as space:
        vision = SeenCustomers(f"{space}/{SEEN}")
        vision.is_heard(context)
        vision.show(False)
        detect = context.service(f"{space}/{DETECT}", AWAIT, timeout=LONG + SLACK, hints=FAILED)
        vision.show(True)
        _finds(context, detect, LONG, NOT_SEEN)
        for patience in (0.0, 60.0):
            _finds(context, detect, patience, NOT_SEEN)
        vision.show(False)
        _finds_nobody(context, detect, 0.0)
        _finds_nobody(context, detect, context.random.number(1.2, 1.5))
        for _ in range(context.random.integer(40, 60)):
            _is_nobody(context, detect(patience=0.0))
        context.fulfilled(WAITED)
        _serves_several_callers(context, detect, vision)
        context.fulfilled(SEVERAL)
        _refuses_impossible_patience(context, detect, vision)


def _finds(context: CheckContext, detect: Service, patience: float, hint: str, within: float = SLACK) -> None:
    response = detect(patience=patience)
    context.expect("the node finds a customer", expected=True, actual=response.found, hints=hint)
    context.require(
        "the node finds a customer immediately",
        holds=detect.took < within,
        expected="an immediate response",
        actual=f"a response after {detect.took:.1f} s",
        hints=(
            "A customer was there before the call, but the handler waited. First check for a customer, "
            "and wait only if no customer is there."
        ),
    )


def _finds_nobody(context: CheckContext, detect: Service, patience: float) -> None:
    _is_nobody(context, detect(patience=patience))
    context.require(
        "without a customer, the call takes `patience` seconds",
        holds=patience - EARLY < detect.took < patience + SLACK,
        expected=f"a response after {patience:g} s",
        actual=f"a response after {detect.took:.1f} s",
        hints=NO_WAIT if detect.took < patience else TOO_LONG,
    )


def _is_nobody(context: CheckContext, response: Message) -> None:
    context.expect(
        "without a customer, `found` is False", expected=False, actual=response.found, hints=REMEMBERED
    )


def _serves_several_callers(context: CheckContext, detect: Service, vision: SeenCustomers) -> None:
    """Let several calls wait, make a short call during this time, and then let a customer come."""
    with ThreadPoolExecutor(CALLERS) as pool:
        began = time.monotonic()
        waiting = _calls_that_wait(pool, detect, vision, LATER)
        time.sleep(BEGUN)
        short = context.service(detect.name, AWAIT, timeout=LATER)
        response = short(patience=0.0)
        context.require(
            "a call that waits does not block other calls",
            holds=not response.found and time.monotonic() - began < LATER,
            expected="an immediate response",
            actual="a response after the customer had come",
            hints=ONE_BY_ONE,
        )
        late, found = zip(*[each.result() for each in waiting], strict=True)
        context.require(
            "all waiting calls get a response when the customer comes",
            holds=min(late) > -2 * EARLY and max(late) < SLACK and all(found),
            expected=f"{CALLERS} responses with found=True after {LATER:g} s",
            actual=f"responses after {LATER + min(late):.1f} to {LATER + max(late):.1f} s",
            hints=NOT_WOKEN if max(late) >= SLACK else NO_WAIT,
        )
        latest = max(late)
        for _ in range(ATTEMPTS - 1):
            if latest < PROMPT:
                break
            vision.show(False)
            again = _calls_that_wait(pool, detect, vision, SOONER)
            latest = min(latest, max(each.result()[0] for each in again))
    context.require(
        "all waiting calls get a response when the customer comes",
        holds=latest < PROMPT,
        expected="each response immediately after the customer has come",
        actual=f"a response {latest:.1f} s after the customer has come",
        hints=POLLED,
    )


def _calls_that_wait(
    pool: ThreadPoolExecutor, detect: Service, vision: SeenCustomers, later: float
) -> list[Future[tuple[float, bool]]]:
    """Begin `CALLERS` calls one after another; later, let a customer come.

    `later` is the time in s until the customer comes.

    For each call, the result is the time in s from the customer to the response, and the field `found`.
    """
    came = time.monotonic() + later
    vision.show_later(later, True)

    def call(number: int) -> tuple[float, bool]:
        time.sleep(number * APART)
        (reply,) = detect.at_once([{"patience": LONG}])
        return time.monotonic() - came, reply.response.found

    return [pool.submit(call, number) for number in range(CALLERS)]


def _refuses_impossible_patience(context: CheckContext, detect: Service, vision: SeenCustomers) -> None:
    vision.show(False)
    hasty = context.service(detect.name, AWAIT, timeout=3.0)
    for what, patience in (
        ("negative", -context.random.number(0.1, 5.0)),
        ("above 60", context.random.number(60.1, 60.9)),
        ("infinite", math.inf),
        ("nan", math.nan),
    ):
        refused(
            context,
            hasty,
            f"the node immediately refuses a value of `patience` that is {what}",
            "patience",
            patience=patience,
            hints=[
                (matches("TimesUp"), NAN if what == "nan" else FIRST),
                (matches("cannot process request"), NAMELESS),
                (ANYTHING, NAN if what == "nan" else UNREFUSED),
            ],
        )


SILENT = 'The error message does not contain the word "camera". Write this word into the message.'
OLD = (
    "The handler used a message that is older than 1 s. Store the time at which each message arrives, "
    "and compare this time with the current time."
)
NOBODY_KNOWS = (
    "Without messages from the camera, the node does not know whether a customer is there. After "
    "request.patience seconds, raise rospy.ServiceException; do not return found=False."
)
TOO_SOON = (
    "The node refused the call too early. Wait for request.patience seconds, because a new message "
    "can still arrive."
)
BEFORE = (
    "A message can also be valid if it arrived before the call. Check whether the message is less "
    "than 1 s old."
)
FRESH = "The node did not use the last message. A message is valid if it is less than 1 s old."
STOPPED = (
    "A message came during the call, but it was older than 1 s at the end of the call. After "
    "request.patience seconds, check the age of the newest message again, and refuse the call."
)
CAME_BACK = (
    "The camera stopped for some time, but new messages came before the end of the call. Use the "
    "newest message, even if it came after a pause."
)

REFUSED_TOO_MUCH: Hints = [(matches("camera"), FRESH), *FAILED[1:]]
REFUSED_RETURN: Hints = [(matches("camera"), CAME_BACK), *FAILED[1:]]


@part(
    "15.3",
    points=2,
    goal=(
        "Extend customer_detector.py: detect_customer refuses a call if no message came in the last second."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME, "# Copy your program of exercise 15.2 into this cell, and extend the copy.\n..."),
    goals={
        SILENT_CAMERA: 3,
        (
            "If the camera stops during a call, refuse the call. If the camera starts again during a call, "
            "use the new messages."
        ): 1,
    },
)
def the_silent_camera(context: CheckContext) -> None:
    """Call the detector before the first message, 0.4 s and 1.2 s after a message, and after new messages."""
    with student_node(context, NAME, INTERFACE) as space:
        vision = SeenCustomers(f"{space}/{SEEN}")
        vision.is_heard(context)
        name = f"{space}/{DETECT}"
        detect = context.service(name, AWAIT, timeout=LONG + SLACK, hints=REFUSED_RETURN)
        _refuses(context, detect, 0.3, "before the first message, the node refuses a call")
        vision.show_later(0.4, True)
        _finds(context, detect, LONG, CAME_BACK, within=LONG / 2)
        vision.customer = None
        _counts_for_a_second(context, name, vision)
        while vision.silent_for() < 1.2:
            time.sleep(0.05)
        _refuses(context, detect, 0.3, "after 1 s without a message, the node refuses a call")
        context.fulfilled(SILENT_CAMERA)
        vision.show(False)
        vision.customer = None
        _counts_before_the_call(context, name, vision)
        vision.customer = False
        vision.show_later(0.2, None)
        _refuses(
            context, detect, 1.8, "if the camera stops during a call, the node refuses this call", STOPPED
        )
        vision.show_later(0.5, False)
        response = detect(patience=1.0)
        context.expect(
            "if messages arrive again during a call, this call succeeds",
            expected=False,
            actual=response.found,
            hints=CAME_BACK,
        )


def _counts_for_a_second(context: CheckContext, name: str, vision: SeenCustomers) -> None:
    time.sleep(0.4)
    detect = context.service(name, AWAIT, timeout=LONG, hints=REFUSED_TOO_MUCH)
    found = True
    if vision.silent_for() < 0.8:
        found = detect(patience=0.0).found
    if vision.silent_for() > 1.0:  # Skip this assertion, because the machine is too busy.
        found = True
    context.expect("a message is valid for one second", expected=True, actual=found, hints=FRESH)


def _counts_before_the_call(context: CheckContext, name: str, vision: SeenCustomers) -> None:
    """Make one call shortly after the last message, which reports that no customer is there."""
    if vision.silent_for() > 0.5:
        return  # Skip this assertion, because the machine is too busy.
    detect = context.service(name, AWAIT, timeout=LONG, hints=[(matches("camera"), BEFORE), *FAILED[1:]])
    found = detect(patience=0.0).found
    context.expect("a message is valid for one second", expected=False, actual=found, hints=REMEMBERED)


def _refuses(
    context: CheckContext, detect: Service, patience: float, assertion: str, not_refused: str = NOBODY_KNOWS
) -> None:
    started = time.monotonic()
    refused(
        context,
        detect,
        assertion,
        "camera",
        patience=patience,
        hints=[
            (matches("TimesUp"), TOO_LONG),
            (matches("cannot process request"), SILENT),
            (matches("True"), OLD),
            (ANYTHING, not_refused),
        ],
    )
    took = time.monotonic() - started
    context.require(
        "the node refuses the call after `patience` seconds, not earlier",
        holds=took > patience - EARLY,
        expected=f"an error after {patience:g} s",
        actual=f"an error after {took:.1f} s",
        hints=TOO_SOON,
    )
