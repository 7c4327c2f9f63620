"""03.3: a handler that waits for a customer, and not for ever."""

from __future__ import annotations

import time
from threading import Timer

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.plain import Message
from course_pkg.examiner.publishing import Publishing
from course_pkg.examiner.waiting import until

DETECT = "course_pkg/DetectCustomer"
COUNTER = "std_msgs/UInt32MultiArray"
SLACK = 1.5  # s: a busy machine is no mistake
LONG = 2.0  # s of patience where nobody comes: twice as long is beyond the slack
LATER = 0.6  # s until somebody comes
PATIENCE = 5.0  # s, where it must not run out
LOOKS = 3000  # in about a second: a pause of a millisecond makes 1100, none at all many thousands

# A shop of the check's own: the student's handler with a new Watch, on names that nobody knows.
A_SHOP = """
import functools

import rospy
from course_pkg.shop import Watch
from course_pkg.srv import DetectCustomer
from std_msgs.msg import UInt32MultiArray


class Counted(Watch):
    looks = 0

    @property
    def told(self):
        return self.silent_for < 60

    def next(self, after=0):
        self.looks += 1
        return super().next(after)


class Shop:
    def open(self, handler, counter, service):
        self.watch = Counted(rospy.Time.now)
        self.camera = rospy.Subscriber(counter, UInt32MultiArray, self.watch.hear)
        self.service = rospy.Service(service, DetectCustomer, functools.partial(handler, self.watch))

    def close(self):
        self.camera.unregister()
        self.service.shutdown("checked")


shop = Shop()
"""
SINCE_WHEN = "the answer says since when the customer is there"
AT_ONCE = (
    "Somebody was there before the question. Look first, and wait only if nobody is: wait_for does both."
)
BUSY = (
    "A loop without a pause looks thousands of times a second. Let watch.changed.wait_for(...) wait: it "
    "sleeps until something has changed."
)
CHANGED = (
    "The answer was no before the time was over, and somebody came then. A change at the counter may be that "
    "somebody went: wait_for(question, timeout=...) waits until the question has an answer."
)
FOREVER = "It waits for longer than it was told to. Give the wait its limit: timeout=request.patience."
HELD = (
    "Somebody came, and could not be seen: it holds `changed` while it sleeps, and the camera's word cannot "
    "get in. changed.wait_for(...) lets go of it while it waits."
)
TOO_EARLY = (
    "The caller would have waited, and the answer came before the time was over. Wait for a customer: "
    "watch.changed.wait_for(..., timeout=request.patience)."
)
ERRORS = {
    says("cannot (wait on|notify on) un-acquired lock"): "Waiting begins inside: with watch.changed: ...",
    says(
        "returned None"
    ): "The handler came to its end without a return. It needs one also when nobody came.",
    says("'NoneType' object has no attribute"): (
        "When nobody came, watch.next() is None, and has no number: look before you take it."
    ),
    says("not callable"): (
        "wait_for takes a function, to call it after each change, such as lambda: watch.next(request.after)."
    ),
    says("TimesUp"): FOREVER,
    says("cannot process request"): "Nobody came, and that is an answer, no error: False, 0, rospy.Time().",
}


@part(
    "03.3",
    points=3,
    goal="Answer as soon as there is a customer, and after the patience of the caller in any case.",
    needs=["handle_detect"],
    deadline=45.0,
)
def a_question_that_waits(exam: Exam) -> None:
    """Begin with nobody; then have somebody there, known, and coming; then several callers at once."""
    counter, name = (f"/{exam.draw.word()}" for _ in range(2))
    exam.prepare(A_SHOP)
    opened = exam.run("shop.open", Its("handle_detect"), counter, name, worded="rospy.Service(...)")
    exam.hold("the handler can be served", not opened.error, seen=opened.error)
    try:
        shop = _Shop(exam, counter)
        detect = exam.service(name, DETECT, hints=ERRORS, timeout=9.0)
        _nobody(exam, detect)
        _somebody(exam, detect, shop)
        _several(exam, detect, shop)
    finally:
        exam.run("shop.close")


class _Shop:
    """Says who is at the counter, as the camera does: over and over."""

    def __init__(self, exam: Exam, counter: str) -> None:
        self._exam, self._counter = exam, counter
        self._saying: Publishing | None = None
        self.there()
        self._await("told", True)

    def there(self, *numbers: int) -> None:
        """Have these at the counter, and nobody else."""
        if self._saying:
            self._saying.stop()
        self._saying = self._exam.publish(self._counter, COUNTER, [{"data": numbers}], every=0.05)

    def later(self, seconds: float, *numbers: int) -> None:
        """Have these at the counter `seconds` from now."""
        Timer(seconds, self.there, numbers).start()

    def await_sight(self, count: int) -> None:
        """Wait until the student's handler could know that so many are at the counter."""
        self._await("count", count)

    def _await(self, name: str, value: int) -> None:
        until(lambda: self._exam.read(f"shop.watch.{name}") == value, 5.0)


def _nobody(exam: Exam, detect: Service) -> None:
    for patience in (0.0, LONG):
        looks = exam.read("shop.watch.looks")
        response = detect(after=0, patience=patience)
        _no(exam, response)
        exam.hold(
            "the answer comes when the patience is over",
            patience - 0.1 <= detect.took < patience + SLACK,
            expected=f"an answer after {patience:g} s",
            seen=f"an answer after {detect.took:.1f} s",
            hints=TOO_EARLY if detect.took < patience else FOREVER,
        )
        exam.hold(
            "who waits leaves the processor alone",
            exam.read("shop.watch.looks") - looks < LOOKS,
            expected="a few looks at the counter while nothing happens",
            seen="thousands of looks",
            hints=BUSY,
        )


def _no(exam: Exam, response: Message) -> None:
    exam.expect(
        "no customer, no detection",
        expected=[False, 0, 0.0],
        seen=[response.detected, response.number, response.arrived.to_sec()],
        hints={
            (lambda seen: seen[:2] == [False, 0]): "Nobody came: arrived is rospy.Time(), which is zero.",
            says(""): "Nobody is there, so detected is False and number is 0.",
        },
    )


def _somebody(exam: Exam, detect: Service, shop: _Shop) -> None:
    known, coming = sorted(exam.draw.integers(2, 100, 900))
    shop.there(known)
    shop.await_sight(1)
    response = detect(after=0, patience=PATIENCE)
    _found(exam, detect, response, known)
    _at_once(exam, "one who is there already is found at once", detect.took, hint=AT_ONCE)
    again = detect(after=0, patience=0.0)
    exam.hold(
        "one who is there is found by a look, too",
        again.detected,
        expected="detected with patience 0",
        seen="nobody",
        hints="With no patience at all there is still time for a look.",
    )
    exam.expect(
        SINCE_WHEN,
        expected=response.arrived.to_sec(),
        seen=again.arrived.to_sec(),
        hints="Asked twice about the same customer, it gave two times. What counts is not the time of the "
        "answer, but when the customer was first seen: customer.arrived.",
    )
    shop.later(LATER / 2)  # the one who is known goes: a change, and not the one that is waited for
    shop.later(LATER, coming)
    response = detect(after=known, patience=PATIENCE)
    exam.hold(
        "who is known already is not told again",
        response.number != known,
        expected=f"a customer above {known}",
        seen=known,
        hints="The caller knows that one, and says so with `after`: ask watch.next(request.after).",
    )
    _found(exam, detect, response, coming)
    hint = "Somebody came, and the caller was left waiting. Return as soon as wait_for returns."
    _at_once(exam, "one who comes is told of at once", detect.took, LATER, hint)


def _found(exam: Exam, detect: Service, response: Message, number: int) -> None:
    exam.hold(
        "a customer who is there is detected",
        response.detected,
        expected=f"detected, and the number {number}",
        seen=response,
        hints={
            (lambda seen: seen["number"] > 0): "The number is there, and detected is False: set it, too.",
            says(""): HELD if detect.took > PATIENCE - 0.5 else CHANGED,
        },
    )
    exam.expect(
        "the answer has the customer's number",
        expected=number,
        seen=response.number,
        hints={
            0: "number is 0, as a field is that never gets a value. The customer has it: customer.number.",
            1: "That is how many there are, or True. The customer has a number: customer.number.",
        },
    )
    exam.hold(
        SINCE_WHEN,
        abs(response.arrived.to_sec() - time.time()) < 30.0,
        expected="the time at which the customer was first seen",
        seen=f"{response.arrived.to_sec():.1f} s",
        hints="The customer has it: arrived=customer.arrived.",
    )


def _several(exam: Exam, detect: Service, shop: _Shop) -> None:
    coming = exam.draw.integer(1000, 9000)
    shop.there()
    shop.await_sight(0)
    shop.later(LATER, coming)
    in_vain = {"after": coming, "patience": LATER + SLACK + 1.0}
    waiting = {"after": coming - 1, "patience": PATIENCE}
    *vain, one, two, three = detect.at_once([in_vain] * 2 + [waiting] * 3)
    replies = [one, two, three]
    exam.expect(
        "everybody who waits is answered",
        expected=[coming] * 3,
        seen=[reply.response.number for reply in replies],
        hints="Three asked at the same time, and one customer came for all of them.",
    )
    hint = "One caller had to wait for another one. Don't hold a lock of your own while you wait."
    _at_once(exam, "several callers wait side by side", max(reply.took for reply in replies), LATER, hint)
    for reply in vain:
        _no(exam, reply.response)


def _at_once(exam: Exam, rule: str, took: float, after: float = 0.0, hint: str = "") -> None:
    """Hold that an answer came when the customer did, `after` s from the question."""
    exam.hold(
        rule,
        took < after + SLACK,
        expected=f"an answer {after:g} s after the question" if after else "an answer at once",
        seen=f"an answer after {took:.1f} s",
        hints=hint,
    )
