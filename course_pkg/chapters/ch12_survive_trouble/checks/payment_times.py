"""Measures pauses and durations for 12.3, each of them several times, because the machine may be busy."""

from __future__ import annotations

from typing import NoReturn

from course_pkg.chapters.ch12_survive_trouble.checks.payments import (
    DEADLINE,
    GIVEN_UP,
    UNKNOWN,
    pay,
    why_given_up,
)
from course_pkg.checking import CheckContext, HangUp, Late, matches
from course_pkg.checking.peers.faulty_server import Fault, FaultyServer
from course_pkg.checking.result import Result

TRY = 0.5  # TRY is the time limit in s for one attempt.
PAUSE = 0.1  # PAUSE is the time in s before the second attempt.
# The shortest first pause, together with the time for a new connection, may take up to this time in s.
FIRST = 1.8 * PAUSE
PAYMENTS = 5  # The check measures each pause or duration in at most this many payments.
REPEATED = 3  # The pause after a TimeoutError is measured in at most this many payments.
# In these payments, a slow till responds after this time in s, which is longer than an attempt may take.
TOO_LATE = 1.25 * TRY
# AT_END is the time in s from the start of a payment to its deadline. At the deadline, the client is in its
# fourth pause, which would end after 1.5 s.
AT_END = 0.9
ENDED = 1.3  # If no till is running, the fastest of several payments may take up to this time in s.
AT_WORK = 0.5  # A client must make attempts for at least this time in s.
TOO_LONG = (
    "An attempt took longer than 0.5 s, and its response came too late. Limit each attempt to half a second."
)
GONE = (
    "No server offers the till's service, but pay() waits for this service without a time limit. Use the "
    "remaining time as the limit of each wait."
)
STOPPED = (
    "pay() ended before the deadline. Repeat the call until the time in the argument `deadline` (in "
    "seconds) is over."
)
LONG_PAUSE = (
    "The first pause is too long: it has to be 0.1 s. Double the pause after the sleep, not before the sleep."
)
OVERSLEPT = (
    "The last pause ended after the deadline. Sleep no longer than the time that remains until the deadline."
)


def pauses_for_a_moment(context: CheckContext, name: str, till: FaultyServer) -> None:
    """Let one attempt fail, and measure the next pause; repeat this, and use the shortest pause."""
    pauses = []
    for _ in range(PAYMENTS):
        first, second, *_ = _arrivals(context, name, till, [Fault(HangUp())])
        pauses.append(second - first)
        if pauses[-1] < FIRST:
            break
    context.require(
        "there is a pause before the next attempt",
        holds=min(pauses) < FIRST,
        expected=f"a pause of {PAUSE:g} s after the first attempt",
        actual=f"a pause of {min(pauses):.2f} s",
        hints=LONG_PAUSE,
    )


def pauses_after_a_timeout(context: CheckContext, name: str, till: FaultyServer) -> None:
    """Let the fourth attempt reach its time limit, and measure the next pause, which has to take 8 * PAUSE.

    If the machine is busy, each request may arrive late. The pause before the fifth attempt is measured,
    because this pause is much longer than such a delay. A short pause is measured again.
    """
    faults = [*[Fault(HangUp())] * 3, Fault(Late(TOO_LATE, {}), worked=True)]
    pauses = []
    for _ in range(REPEATED):
        *_, fourth, fifth = _arrivals(context, name, till, faults)
        pauses.append(fifth - fourth - TRY)
        if pauses[-1] > 3.5 * PAUSE:
            break
    context.require(
        "there is a pause before the next attempt",
        holds=max(pauses) > 3.5 * PAUSE,
        expected=f"a pause of {8 * PAUSE:g} s after the fourth attempt",
        actual=f"a pause of {max(pauses):.2f} s",
        hints="There was no pause after a TimeoutError. Sleep after every failed call.",
    )


def _arrivals(context: CheckContext, name: str, till: FaultyServer, faults: list[Fault]) -> list[float]:
    """Pay while the till has the given faults; return the times of the requests: one more than faults.

    If a request is missing, repeat the payment, because on a busy machine, an earlier attempt may arrive late
    and remove a fault, or the client may get a response that is slightly too late.
    """
    for _ in range(REPEATED):
        before = len(till.arrivals)
        till.plan.extend(faults)
        result = pay(context, name, context.random.integer(100, 900), DEADLINE)
        receipt, arrivals = result.returned(), till.arrivals[before:]
        till.plan.clear()
        if receipt is None or len(arrivals) > len(faults):
            break
    if len(arrivals) <= len(faults):
        _too_few_attempts(context, len(faults), len(arrivals), result)
    return arrivals[: len(faults) + 1]


def _too_few_attempts(context: CheckContext, faults: int, attempts: int, result: Result) -> NoReturn:
    """Report a payment that has not more attempts than the till has faults; `result` is its result."""
    waited = result.value is not None and attempts == faults
    context.fail(
        "after a failed attempt, pay() calls the till again",
        expected=f"{faults + 1} attempts",
        actual=f"attempts: {attempts}, and the result {result.value}",
        hint=TOO_LONG if waited else why_given_up("failing", result.took, attempts),
    )


def ends_without_a_till(context: CheckContext) -> None:
    """Pay several times while no till is running, and use the time of the fastest payment."""
    times = []
    for _ in range(PAYMENTS):
        cents = context.random.integer(100, 900)
        gone = [(matches("TimesUp"), GONE), *GIVEN_UP]
        result = pay(context, f"/{context.random.word()}", cents, AT_END, gone)
        context.expect(
            "pay() returns None when the deadline has passed",
            expected=None,
            actual=result.returned(),
            hints=UNKNOWN,
        )
        context.require(
            "pay() makes attempts until the deadline",
            holds=result.took > AT_WORK,
            expected=f"attempts for {AT_END:g} s",
            actual=f"pay() ended after {result.took:.1f} s",
            hints=STOPPED,
        )
        times.append(result.took)
        if times[-1] < ENDED:
            break
    context.require(
        "pay() ends at the deadline",
        holds=min(times) < ENDED,
        expected=f"pay() ends after {AT_END:g} s or slightly more",
        actual=f"pay() ended after {min(times):.1f} s",
        hints=OVERSLEPT,
    )
