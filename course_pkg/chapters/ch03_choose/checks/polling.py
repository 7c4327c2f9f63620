"""03.1: a client that polls at a limited rate, and only for a limited time."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

from course_pkg.checking import ANYTHING, CheckContext, Late, matches, part
from course_pkg.checking.peers.scripted_server import Act, ScriptedServer
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Result
from course_pkg.ros.protocol.json_channel import Json

DETECT = "course_pkg/DetectCustomer"
SLACK = 0.7  # SLACK is the additional time in s that a call of poll() may take on a busy machine.
NO_NUMBER = "poll() returned None, although a customer was there. Return the number of the customer."
AT_ONCE = 0.9  # If a request comes within this time in s, the client has not paused before it.
PAUSED_FIRST = (
    "A customer was there, but poll() paused before the first call. Call the service "
    "first, and pause only after a response without a customer."
)
NO_PAUSE = "Pause for 1 / rate seconds between two calls."
NO_END = (
    "poll() continues after its time is over. Before each call, compare the current time with the "
    "end time, which is the start time plus the argument `seconds`."
)

COUNTED = (
    "Each call also takes time, so the number of calls does not show when poll() has to end. Before "
    "each call, compare the current time with the end time."
)


@dataclass
class Counter:
    """A detector with one customer.

    `after` is the time in s from the creation of this object until the customer comes. `slow` is the delay of
    each response in s.
    """

    number: int
    after: float
    slow: float = 0.0
    asked: list[float] = field(default_factory=list)
    opened: float = field(default_factory=time.monotonic)

    def answer(self, _: Message) -> Act:
        """Record the time of a request, and return the response."""
        self.asked.append(time.monotonic())
        there = self.asked[-1] - self.opened >= self.after
        answer: dict[str, Json] = {"detected": there, "number": self.number if there else 0}
        return Late(self.slow, answer) if self.slow else answer


FOUND = "Return the number of the customer who is already there or who comes later."


@part(
    "03.1",
    points=2,
    goal="Poll until a customer is there. The rate of the calls and the total time are limited.",
    needs=["poll"],
    deadline=30.0,
    goals=[FOUND, "Return None when the time is over. Make no more calls than the rate allows."],
)
def poll_with_a_deadline(context: CheckContext) -> None:
    """Call poll() while a customer is there, and before a customer comes.

    At the end, no customer comes: call poll() with a fast detector, with a slow detector, and at a low rate.
    """
    _one_who_is_there(context)
    _one_who_comes(context)
    context.fulfilled(FOUND)
    _nobody(context)
    _nobody_slowly(context)
    _nobody_at_a_low_rate(context)


def _one_who_is_there(context: CheckContext) -> None:
    counter = Counter(context.random.integer(100, 999), after=0.0)
    seconds, rate = context.random.number(3.0, 5.0), context.random.number(0.6, 1.0)
    result = _polled(context, counter.answer, seconds=seconds, rate=rate)
    context.expect(
        "the number of the customer is returned",
        expected=counter.number,
        actual=result.returned(),
        hints=_NUMBER,
    )
    context.expect(
        "poll() makes no call after it has found a customer",
        expected=1,
        actual=len(counter.asked),
        hints=(
            "poll() called the service a second time, although the first response contained a customer. "
            "Store the response, and return the number from the response."
        ),
    )
    context.require(
        "poll() does not pause if a customer is there",
        holds=result.took < AT_ONCE,
        expected="poll() returns immediately if a customer is there",
        actual=f"poll() returned after {result.took:.1f} s",
        hints=(
            PAUSED_FIRST
            if counter.asked[0] - counter.opened > AT_ONCE
            else (
                "The response contained a customer, but poll() paused before it returned. Pause only after a "
                "response without a customer."
            )
        ),
    )


def _one_who_comes(context: CheckContext) -> None:
    after, seconds, rate = (context.random.number(*limits) for limits in ((0.6, 0.7), (3.5, 4.4), (4.5, 5.5)))
    counter = Counter(context.random.integer(100, 999), after=after)
    result = _polled(context, counter.answer, seconds=seconds, rate=rate)
    context.expect(
        "a customer who comes later is found",
        expected=counter.number,
        actual=result.returned(),
        hints=[
            (
                None,
                "poll() stopped after the first response, before the time was over. Call the service again."
                if len(counter.asked) == 1 and result.took < seconds + 0.5
                else NO_PAUSE,
            ),
            *_NUMBER,
        ],
    )
    context.require(
        "a customer does not wait longer than one pause",
        holds=result.took < after + 1 / rate + SLACK,
        expected=f"poll() returns about {1 / rate:.1f} s after the customer came",
        actual=f"poll() returned {result.took - after:.1f} s after the customer came",
        hints=f"poll() called the service too rarely. {NO_PAUSE}",
    )


def _nobody(context: CheckContext) -> None:
    counter = Counter(0, after=float("inf"))
    seconds, rate = context.random.number(1.8, 2.4), context.random.number(8.0, 9.0)
    result = _polled(context, counter.answer, seconds=seconds, rate=rate)
    context.expect(
        "poll() returns None if no customer comes",
        expected=None,
        actual=result.returned(),
        hints=[
            (0, "If no customer is there, the field `number` is 0. Return None in this case."),
            (ANYTHING, "No customer came. Return None when the time is over."),
        ],
    )
    pauses = sorted(later - earlier for earlier, later in pairwise(counter.asked))
    # On a busy machine, rospy.Rate makes some pauses shorter.
    if 3 < len(pauses) < seconds * rate + 3 and pauses[len(pauses) // 3] < 0.3 / rate:
        context.fail(
            "poll() does not make more calls than the rate allows",
            expected=f"a pause of {1 / rate:.2f} s between two calls",
            actual=f"{len(counter.asked)} calls, several of them without a pause",
            hint=f"poll() made several calls without a pause, and then made a long pause. {NO_PAUSE}",
        )
    context.require(
        "poll() does not make more calls than the rate allows",
        holds=len(counter.asked) <= seconds * rate + 2,
        expected=f"at most {seconds * rate + 1:.0f} calls in {seconds:g} s, at {rate:g} per second",
        actual=f"{len(counter.asked)} calls",
        hints=f"poll() made too many calls, and each call costs processor time. {NO_PAUSE}",
    )
    context.require(
        "poll() continues until the time is over",
        holds=result.took > seconds - 1 / rate - 0.2,
        expected=f"calls for {seconds:g} s",
        actual=f"poll() returned after {result.took:.1f} s",
        hints=(
            "poll() returned before the time in `seconds` was over. Continue to poll until the end "
            "of this time."
        ),
    )
    context.require(
        "poll() makes about as many calls as the rate allows",
        holds=len(counter.asked) >= seconds * rate / 3,
        expected=f"up to {seconds * rate + 1:.0f} calls in {seconds:g} s",
        actual=f"{len(counter.asked)} calls",
        hints=f"poll() made too few calls, so customers have to wait longer. {NO_PAUSE}",
    )
    counted = len(counter.asked) <= seconds * rate + 1
    _ends_in_time(context, result, seconds + 1 / rate, COUNTED if counted else NO_END)


def _nobody_slowly(context: CheckContext) -> None:
    counter = Counter(0, after=float("inf"), slow=0.3)
    seconds, rate = context.random.number(1.1, 1.4), context.random.number(9.0, 11.0)
    result = _polled(context, counter.answer, seconds=seconds, rate=rate)
    context.require(
        "poll() makes about as many calls as the rate allows",
        holds=len(counter.asked) > 1,
        expected="several calls",
        actual=f"{len(counter.asked)} calls",
        hints=f"poll() made too few calls while no customer came. {NO_PAUSE}",
    )
    _ends_in_time(context, result, seconds + 0.3 + 1 / rate, COUNTED)


def _nobody_at_a_low_rate(context: CheckContext) -> None:
    counter = Counter(0, after=float("inf"))
    seconds, rate = context.random.number(1.1, 1.3), context.random.number(1.2, 1.4)
    _polled(context, counter.answer, seconds=seconds, rate=rate)
    context.require(
        "poll() does not make more calls than the rate allows",
        holds=len(counter.asked) <= seconds * rate + 2,
        expected=f"at most {seconds * rate + 1:.0f} calls in {seconds:g} s, at {rate:g} per second",
        actual=f"{len(counter.asked)} calls",
        hints=(
            "At a low rate, poll() made more calls than the rate allows. Calculate the pause from the "
            "argument `rate`."
        ),
    )


def _ends_in_time(context: CheckContext, result: Result, latest: float, hint: str = NO_END) -> None:
    result.returned()
    context.require(
        "poll() ends when the time is over",
        holds=result.took < latest + SLACK,
        expected=f"poll() returns after about {latest:.1f} s",
        actual=f"poll() returned after {result.took:.1f} s",
        hints=hint,
    )


def _polled(
    context: CheckContext, script: Callable[[Message], Act], *, seconds: float, rate: float
) -> Result:
    name = f"/{context.random.word()}"
    server = context.serve(name, DETECT, script)
    hints = [
        (
            matches("unavailable"),
            "poll() did not call the given service. Pass the name in `service` to rospy.ServiceProxy.",
        ),
        (matches("^TimesUp"), NO_END),
        (
            matches("^(TimeoutError|ROSException)"),
            "No customer came, but poll() raised an exception. Return None in this case.",
        ),
        (
            matches("is not an attribute of DetectCustomerRequest"),
            "Your function uses a field that the request does not have. The fields of the request are "
            "`after` and `patience`.",
        ),
    ]
    result = context.run("poll", name, seconds, rate, within=8.0, hints=hints)
    result.returned()
    _asked_as_it_should(context, server)
    return result


def _asked_as_it_should(context: CheckContext, server: ScriptedServer) -> None:
    context.require(
        "poll() calls the service whose name is in `service`",
        holds=bool(server.requests),
        expected="a call of the service whose name is in `service`",
        actual="no call",
    )
    context.expect(
        "the field `patience` of the request is 0",
        expected=0.0,
        actual=_first_other_than_0(server, "patience"),
        hints=(
            "The field `patience` of the request is not 0, so the detector waits for a "
            "customer. Use patience=0."
        ),
    )
    context.expect(
        "the field `after` of the request is 0",
        expected=0,
        actual=_first_other_than_0(server, "after"),
        hints=(
            "The field `after` of the request is not 0, so the detector ignores some customers. Use after=0."
        ),
    )


def _first_other_than_0(server: ScriptedServer, name: str) -> Json:
    """Return the first value of the field `name` in the requests that is not 0, or 0 if there is none."""
    return next((request[name] for request in server.requests if request[name]), 0)


_NUMBER = [
    (None, NO_NUMBER),
    (True, "poll() returned the value of the field `detected`. Return the value of the field `number`."),
    (
        lambda actual: "number" in actual,
        "poll() returned the whole response. Return only the field `number` of the response.",
    ),
    (
        ANYTHING,
        "The number that poll() returned is not the number in the response. Return the field `number` "
        "without any change.",
    ),
]
