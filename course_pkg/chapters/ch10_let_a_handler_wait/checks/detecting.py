"""10.2: a handler that waits for a customer, for a limited time."""

from __future__ import annotations

import time
from threading import Timer

from course_pkg.chapters.ch10_let_a_handler_wait.checks.watch_in_kernel import A_SHOP
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.plain_values import Message
from course_pkg.waiting import wait_until

DETECT = "course_pkg/DetectCustomer"
COUNTER = "std_msgs/UInt32MultiArray"
SLACK = 1.5  # SLACK is the additional time in s that a call may take on a busy machine.
# This value of `patience` (s) is for calls without a customer. It is not a whole number. A handler that waits
# twice as long exceeds the time limit of the call.
LONG = 1.7
# A customer comes after this time in s. A handler that polls twice per second then responds 0.48 s late.
LATER = 0.52
# A customer comes this time in s after the call if the handler calls watch.next() only with the lock.
SOON = 0.2
PATIENCE = 5.0  # request.patience has this value in s, which is longer than every wait for a customer.
CHANGE = 2.2  # After this time in s, the customers at the counter change again.
# If a handler polls and does not wait for notifications, it must call watch.next() at least this many times
# in `LONG` s.
SELDOM = 7
LOOKS = 3000  # In `LONG` s, a loop without a pause calls watch.next() more than this many times.

USED = 0.3  # USED is the CPU time in s that the kernel may use within `LONG` s.
# In the fastest of `ATTEMPTS` calls, the response has to come within this time in s after the customer.
PROMPT = 0.45
ATTEMPTS = 3

SINCE_WHEN = "the field `arrived` is the time at which the customer came"
AT_ONCE = (
    "A customer was there before the call, but the handler waited. First check for a customer, and "
    "wait only if no customer is there: `wait_for` does both."
)
BUSY = (
    "Your loop has no pause, so it checks for a customer thousands of times per second. Use "
    "watch.changed.wait_for(...), because this method sleeps until another thread sends a "
    "notification."
)
CHANGED = (
    "The handler returned before the time was over. A change can also mean that a customer has left: "
    "check for a customer again after each change, or use `wait_for`."
)
FOREVER = (
    "The handler waits longer than request.patience seconds. Use request.patience as the timeout of the wait."
)
RESTARTED = (
    "The time limit started again from the beginning when the customers changed. Before the loop, "
    "calculate the time at which the wait ends, or use `wait_for`."
)
LEFT = (
    "The handler called watch.next() twice, but the customer left before the second call. Use the "
    "result of the first call, or make both calls inside one `with watch.changed:` block."
)
MISSED = (
    "A customer came between your call of watch.next() and the wait, so the handler missed the notification. "
    "Call watch.next() and wait() inside one `with watch.changed:` block."
)
RARELY = (
    "The handler calls watch.next() only a few times per second, so it notices a customer late. "
    "Wait with watch.changed.wait_for(...), which checks again after each notification."
)
HELD = (
    "The handler did not notice a new customer, because it holds the lock of `changed` while it "
    "sleeps. Use changed.wait_for(...), which releases the lock during the wait."
)
TOO_EARLY = (
    "The handler returned too early. If no customer is there, wait until request.patience seconds are over, "
    "and do not round this number."
)
ERRORS = [
    (
        matches("cannot (wait on|notify on) un-acquired lock"),
        "The methods `wait` and `wait_for` need the lock. Call these methods inside `with watch.changed:`.",
    ),
    (
        matches("returned None"),
        "The handler returned None, not a response. Return a response even if no customer came.",
    ),
    (
        matches("'NoneType' object has no attribute"),
        "watch.next() returns None if no customer is there, and None has no attribute "
        "`number`. Compare the result with None first.",
    ),
    (
        matches("not callable"),
        (
            "The argument of `wait_for` has to be a function, because `wait_for` calls this function "
            "after each change. For example, pass a lambda."
        ),
    ),
    (matches("TimesUp"), FOREVER),
    (
        matches("cannot process request"),
        (
            "The handler raised an error although it is normal that no customer comes. Return a "
            "response with detected=False."
        ),
    ),
]
FOUND = (
    "Respond as soon as a customer is there. If no customer comes, respond after request.patience seconds."
)


@part(
    "10.2",
    points=3,
    goal=(
        "Respond as soon as a customer is there. If no customer comes, respond after request.patience "
        "seconds."
    ),
    needs=["handle_detect"],
    deadline=45.0,
    goals={FOUND: 2, "Respond to several clients at the same time.": 1},
)
def wait_for_a_customer(context: CheckContext) -> None:
    """Call the service in three cases, and then make several calls at the same time.

    In the first case, no customer comes. In the second case, a customer is there before the call. In the
    third case, a customer comes during the call.
    """
    counter, name = (f"/{context.random.word()}" for _ in range(2))
    context.prepare(A_SHOP)
    opened = context.run("shop.open", Its("handle_detect"), counter, name, worded="rospy.Service(...)")
    context.require("a service can call the handler", holds=not opened.error, actual=opened.error)
    try:
        shop = _Shop(context, counter)
        left = (lambda error: "NoneType" in error and context.read("shop.watch.left"), LEFT)
        detect = context.service(name, DETECT, hints=[left, *ERRORS], timeout=9.0)
        _nobody(context, detect)
        rarely = context.read("shop.watch.looks", int) < SELDOM and not context.read(
            "shop.watch.changed.waits"
        )
        _somebody(context, detect, shop, rarely=rarely)
        _misses_nobody(context, detect, shop)
        context.fulfilled(FOUND)
        _several(context, detect, shop)
    finally:
        context.run("shop.close")


class _Shop:
    """Replaces the camera: repeatedly publishes the numbers of the customers at the counter."""

    def __init__(self, context: CheckContext, counter: str) -> None:
        self._context, self._counter = context, counter
        self._saying: Publisher | None = None
        self.there()
        self._await("told", True)

    def there(self, *numbers: int) -> None:
        """From now on, publish `numbers`, the numbers of the customers at the counter."""
        if self._saying:
            self._saying.stop()
        self._saying = self._context.publish(self._counter, COUNTER, [{"data": numbers}], every=0.05)

    def later(self, seconds: float, *numbers: int) -> Timer:
        """Wait for the time `seconds` (s), and then begin to publish the numbers of the customers.

        Return immediately; the returned timer begins to publish.

        `numbers` contains the numbers of the customers at the counter.
        """
        timer = Timer(seconds, self.there, numbers)
        timer.start()
        return timer

    def is_silent(self) -> None:
        """Publish nothing until the next call of `there` or `later`."""
        if self._saying:
            self._saying.stop()

    def await_sight(self, count: int) -> None:
        """Wait until the kernel has received a message with `count` customers."""
        self._await("count", count)

    def _await(self, name: str, value: int) -> None:
        wait_until(lambda: self._context.read(f"shop.watch.{name}") == value, 5.0)


def _nobody(context: CheckContext, detect: Service) -> None:
    for patience in (0.0, LONG):
        looks, used = context.read("shop.watch.looks", int), context.read("shop.used", float)
        seen = context.processor_time()
        response = detect(after=0, patience=patience)
        _no(context, response)
        context.require(
            "without a customer, the handler responds after request.patience seconds",
            holds=patience - 0.1 <= detect.took < patience + SLACK,
            expected=f"a response after {patience:g} s",
            actual=f"a response after {detect.took:.1f} s",
            hints=TOO_EARLY if detect.took < patience else FOREVER,
        )
        context.require(
            "a waiting handler needs almost no processor time",
            holds=context.read("shop.watch.looks", int) - looks < LOOKS
            and context.read("shop.used", float) - used < USED
            and context.processor_time() - seen < USED,
            expected="a handler that waits while no customer comes",
            actual="a handler that uses the processor all the time",
            hints=BUSY,
        )


def _no(context: CheckContext, response: Message) -> None:
    context.expect(
        "without a customer, `detected` is False, and the other fields are 0",
        expected=[False, 0, 0.0],
        actual=[response.detected, response.number, response.arrived.to_sec()],
        hints=[
            (
                lambda actual: actual[:2] == [False, 0],
                (
                    "The field `arrived` is wrong. If no customer came, set this field to the time 0, "
                    "which is rospy.Time()."
                ),
            ),
            (
                ANYTHING,
                ("No customer is there. Set the field `detected` to False and the field `number` to 0."),
            ),
        ],
    )


def _somebody(context: CheckContext, detect: Service, shop: _Shop, *, rarely: bool) -> None:
    known, coming = sorted(context.random.integers(2, 100, 900))
    shop.there(known)
    shop.await_sight(1)
    response = detect(after=0, patience=PATIENCE)
    _found(context, detect, response, known)
    _at_once(
        context, "if a customer is already there, the handler responds immediately", detect.took, hint=AT_ONCE
    )
    again = detect(after=0, patience=0.0)
    context.require(
        "with patience 0, the handler finds a customer who is already there",
        holds=again.detected,
        expected="a detected customer with patience 0",
        actual="not detected",
        hints=(
            "The handler did not find a customer who was already there. If request.patience is 0, do "
            "not wait, but still call watch.next() once."
        ),
    )
    _same_time(context, response, again)
    shop.later(LATER / 2)  # The customer leaves; this change must not end the wait of the next call.
    shop.later(LATER, coming)
    response = detect(after=known, patience=PATIENCE)
    context.require(
        "the handler returns no customer with a number up to `after`",
        holds=response.number != known,
        expected=f"a customer with a number above {known}",
        actual=known,
        hints=(
            "The handler returned a customer who is already known to the client. Pass request.after to "
            "watch.next(), which then returns only customers with higher numbers."
        ),
    )
    _found(context, detect, response, coming)
    hint = "A customer came, but the handler continued to wait. Return as soon as a customer is there."
    _at_once(context, "if a customer comes, the handler responds immediately", detect.took, LATER, hint)
    late = detect.took - LATER
    _same_time(context, response, detect(after=known, patience=0.0))
    context.require(
        "if a customer comes, the handler responds immediately",
        holds=not rarely,
        expected="a thread that waits for a notification",
        actual=(
            f"fewer than {SELDOM} calls of watch.next() in {LONG:g} s, and no call of wait() between them"
        ),
        hints=RARELY,
    )
    for number in range(coming + 1, coming + ATTEMPTS):
        if late < PROMPT:
            break
        shop.later(LATER, number)
        detect(after=number - 1, patience=PATIENCE)
        late = min(late, detect.took - LATER)
    context.require(
        "if a customer comes, the handler responds immediately",
        holds=late < PROMPT,
        expected="a thread that waits for a notification",
        actual=f"a response {late:.1f} s after the arrival of the customer",
        hints=RARELY,
    )


def _misses_nobody(context: CheckContext, detect: Service, shop: _Shop) -> None:
    """Let a customer come immediately after the handler has called watch.next() without the lock.

    A handler that calls watch.next() only with the lock cannot miss a customer. For such a handler, the
    customer comes `SOON` s after the call.
    """
    number = context.random.integer(1000, 9000)
    shop.is_silent()
    context.run("shop.watch.announce", number)
    coming = shop.later(SOON, number)
    detect(after=number - 1, patience=PATIENCE)
    coming.join()  # Otherwise, the numbers would be published during a later call.
    _at_once(context, "if a customer comes, the handler responds immediately", detect.took, SOON, hint=MISSED)
    context.run("shop.watch.announce", 0)


def _same_time(context: CheckContext, response: Message, again: Message) -> None:
    """Assert that two responses for the same customer contain the same time."""
    difference = abs(again.arrived.to_sec() - response.arrived.to_sec())
    context.require(
        SINCE_WHEN,
        holds=difference == 0,
        expected="the same time in both responses",
        actual=f"a difference of {difference:.4f} s",
        hints=(
            "Two calls for the same customer returned different times. Return customer.arrived, the "
            "time at which the customer was first seen."
        ),
    )


def _found(context: CheckContext, detect: Service, response: Message, number: int) -> None:
    context.require(
        "the handler detects a customer who is there",
        holds=response.detected,
        expected=f"detected, and the number {number}",
        actual=response,
        hints=[
            (
                lambda actual: actual["number"] > 0,
                "The number is right, but `detected` is False. Set `detected` to True.",
            ),
            ((lambda _: context.read("shop.watch.left")), LEFT),
            (ANYTHING, HELD if detect.took > PATIENCE - 0.5 else CHANGED),
        ],
    )
    context.expect(
        "the response has the customer's number",
        expected=number,
        actual=response.number,
        hints=[
            (0, "The field `number` has its default value, 0. Set it to customer.number."),
            (ANYTHING, "The response contains a wrong number. Set the field `number` to customer.number."),
        ],
    )
    context.require(
        SINCE_WHEN,
        holds=abs(response.arrived.to_sec() - time.time()) < 30.0,
        expected="the time at which the customer was first seen",
        actual=f"{response.arrived.to_sec():.1f} s",
        hints="The response does not contain the time. Set the field `arrived` to customer.arrived.",
    )


def _several(context: CheckContext, detect: Service, shop: _Shop) -> None:
    coming = context.random.integer(1000, 9000)
    shop.there()
    shop.await_sight(0)
    _no(context, detect(after=0, patience=0.0))  # Assert that no customer is left from the earlier calls.
    shop.later(LATER, coming)
    shop.later(CHANGE, coming - 1, coming)
    patience = LATER + SLACK + 1.0
    in_vain = {"after": coming, "patience": patience}
    waiting = {"after": coming - 1, "patience": PATIENCE}
    *vain, one, two, three = detect.at_once([in_vain] * 2 + [waiting] * 3)
    replies = [one, two, three]
    context.expect(
        "every waiting client gets the number of the customer",
        expected=[coming] * 3,
        actual=[reply.response.number for reply in replies],
    )
    hint = (
        "One client had to wait for another client. While the handler waits, do not hold any lock "
        "except the lock of the condition."
    )
    _at_once(
        context, "several clients wait at the same time", max(reply.took for reply in replies), LATER, hint
    )
    for reply in vain:
        _no(context, reply.response)
        context.require(
            "without a customer, the handler responds after request.patience seconds",
            holds=patience - 0.1 <= reply.took < patience + SLACK,
            expected=f"a response after {patience:g} s",
            actual=f"a response after {reply.took:.1f} s",
            hints=CHANGED if reply.took < patience else RESTARTED,
        )


def _at_once(context: CheckContext, assertion: str, took: float, after: float = 0.0, hint: str = "") -> None:
    """Assert that the response came immediately after the customer had come.

    `after` is the time in s from the request to the customer.
    """
    context.require(
        assertion,
        holds=took < after + SLACK,
        expected=f"a response {after:g} s after the call" if after else "an immediate response",
        actual=f"a response after {took:.1f} s",
        hints=hint,
    )
