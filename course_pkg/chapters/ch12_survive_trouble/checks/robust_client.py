"""12.3: a client that pays exactly once, even if the server or the connection fails."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from course_pkg.chapters.ch12_survive_trouble.checks.payment_times import (
    ends_without_a_till,
    pauses_after_a_timeout,
    pauses_for_a_moment,
)
from course_pkg.chapters.ch12_survive_trouble.checks.payments import (
    CHARGE,
    DEADLINE,
    GIVEN_UP,
    UNKNOWN,
    Books,
    pay,
    pays_after,
)
from course_pkg.checking import ANYTHING, CheckContext, HangUp, Late, Refuse, Silence, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.faulty_server import Crash, Fault, FaultyServer, Frozen, Stumble
from course_pkg.checking.shared.request_ids import from_a_counter
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import wait_until

TRY = 0.5  # TRY is the time limit in s for one attempt, as in the exercise.
# The pause before the second attempt takes this time in s; each further pause is twice as long as the
# previous pause.
PAUSE = 0.1
# If the till never responds, SHORT is the time in s from the start of the payment to its deadline.
SHORT = 1.0
SLACK = 1.5  # SLACK is the additional time in s that a payment may take on a busy machine.
AWAY = 0.5  # A killed till starts again after this time in s, so the second attempt finds no server.
A_LITTLE = 0.2  # This time in s is shorter than the time limit for one attempt.
# The check repeats the payment until one payment ends before its deadline, but stops after this time in s.
KEEPING = 2.0
# The pauses are tested twice. In the second test, the first MOST attempts fail, and LONG is the time in s
# from the start of the payment to its deadline.
MOST = 5
LONG = 12.0

LIMITED = (
    "The pauses do not grow any more after some attempts. Double each pause, and do not limit the length of "
    "the pause."
)
SLOW_GROWTH = (
    "The pauses do not grow fast enough. After each failed call, make the next pause at least twice as long."
)
SLOW = "slow"
FAULTS = {
    "raising an error in its handler": [Fault(Stumble("list index out of range"))],
    SLOW: [Fault(Late(1.2, {}), worked=True)],
    "frozen": [Fault(Frozen())],
    "killed after it had charged the payment, and started again": [Fault(Crash(AWAY), worked=True)],
    "shut down and started again": [Fault(Crash(AWAY, unregisters=True))],
}
PAID = "Pay at a till that works, and do not repeat a refused payment."
REPEATED = "Pay exactly once at a till that fails and later works again."


@part(
    "12.3",
    points=4,
    goal=(
        "Pay exactly once before a deadline, even if calls of the till fail. Do not repeat a refused payment."
    ),
    needs=["pay"],
    deadline=60.0,
    goals={
        PAID: 1,
        REPEATED: 2,
        (
            "Limit the time of each call, make each pause longer than the previous pause, and end before the "
            "deadline."
        ): 1,
    },
)
def a_robust_client(context: CheckContext) -> None:
    """Run pay() with a till that works, refuses, works again after a failure, or does not respond."""
    books, name = Books(context), f"/{context.random.word()}"
    till = context.faulty(name, CHARGE, books.work)
    _pays(context, name, till, books)
    _refused(context, name, till)
    context.fulfilled(PAID)
    first, *others = FAULTS
    tries = {}
    for words in (first, *context.random.shuffled(others)):
        till.plan.extend(FAULTS[words])
        tries[words] = pays_after(context, name, till, books, words)
    _in_a_random_order(context, name, till, books)
    _repeats_a_bad_return(context, name, till)
    context.fulfilled(REPEATED)
    _limits_each_try(context, name, till, tries[SLOW])
    _pauses_grow(context, name, till, books)
    _gives_up(context, name, till)
    _keeps_the_deadline(context, name, till)
    pauses_for_a_moment(context, name, till)
    pauses_after_a_timeout(context, name, till)
    ends_without_a_till(context)


NO_RECEIPT: Hints = [
    (None, "The till sent a receipt, but pay() returned None. Return the receipt."),
    (
        (lambda actual: isinstance(actual, dict)),
        "pay() returned the whole response. Return only its field `receipt`.",
    ),
]


def _pays(context: CheckContext, name: str, till: FaultyServer, books: Books) -> None:
    cents = context.random.integer(100, 900)
    for number in range(2):
        result = pay(context, name, cents, DEADLINE)
        context.require(
            "pay() calls the till",
            holds=bool(till.requests),
            expected=f"a call of {name}",
            actual="none",
            hints="pay() did not call the till. Call the service whose name is in `till`.",
        )
        _is_a_new_payment(context, till.requests[-1], cents, is_new=len(books.charged) == number + 1)
        context.expect(
            "pay() returns the receipt",
            expected=books.receipt(till.requests[-1]),
            actual=result.returned(),
            hints=NO_RECEIPT,
        )
        context.require(
            "pay() does not send a successful payment again",
            holds=len(till.requests) == number + 1 or result.took > TRY,
            expected="one request for each payment",
            actual=f"{len(till.requests)} requests for {number + 1} payments",
            hints=(
                "The till had sent a receipt, but pay() called the till again. Return as soon "
                "as you have a receipt."
            ),
        )
    context.require(
        "each payment has a different id",
        holds=not from_a_counter([str(each["request_id"]) for each in till.requests]),
        expected="ids that no other program creates",
        actual=", ".join(str(each["request_id"]) for each in till.requests),
        hints=(
            "The ids come from a counter, so another program, or this program after a restart, can "
            "create the same ids. Create each id with uuid.uuid4(), which never returns the same id "
            "twice."
        ),
    )


def _is_a_new_payment(
    context: CheckContext, request: Mapping[str, Json], cents: int, *, is_new: bool
) -> None:
    context.expect("the request contains the amount in cents", expected=cents, actual=request["cents"])
    context.require(
        "the request has an id",
        holds=bool(request["request_id"]),
        expected="a request_id",
        actual="an empty id",
        hints="The field `request_id` is empty. Create an id for each payment with uuid.uuid4().",
    )
    context.require(
        "each payment has a different id",
        holds=is_new,
        expected="a new id",
        actual="the id of the previous payment",
        hints=(
            "Two payments had the same id, so the till did not charge the second payment. Create a "
            "new id in each call of pay()."
        ),
    )


def _refused(context: CheckContext, name: str, till: FaultyServer) -> None:
    before = len(till.requests)
    reason = f"no money on card {context.random.integer(100, 999)}"
    till.plan.extend([Fault(Refuse(reason))] * 3)
    result = pay(context, name, context.random.integer(100, 900), 3.0)
    context.expect(
        "pay() does not repeat a refused payment",
        expected=1,
        actual=len(till.requests) - before,
        hints=(
            "The till refused the payment, but pay() called the till again. If an error contains "
            '"cannot process request" but not "handler returned", raise this error again.'
        ),
    )
    result.raised(
        "if the till refuses, pay() raises the error of this call",
        "ServiceException",
        saying=reason,
        hints=[
            (
                None,
                (
                    "The till refused the payment, but pay() did not raise an error. Raise the "
                    "ServiceException again."
                ),
            ),
            (
                ANYTHING,
                (
                    "pay() raised a different error. Raise the same ServiceException again: write "
                    "`raise` without an argument."
                ),
            ),
        ],
    )
    till.plan.clear()


def _in_a_random_order(context: CheckContext, name: str, till: FaultyServer, books: Books) -> None:
    """Let the till refuse or fail in a random order; a client with a fixed list of results fails."""
    refusals, failures = (context.random.integer(1, 2) for _ in range(2))
    for refuses in context.random.shuffled([True] * refusals + [False] * failures):
        if refuses:
            _refused(context, name, till)
        else:
            till.plan.append(Fault(HangUp()))
            pays_after(context, name, till, books, "failing once")


def _repeats_a_bad_return(context: CheckContext, name: str, till: FaultyServer) -> None:
    """Let the handler do its work and return None; the client gets an error message similar to a refusal."""
    till.plan.append(Fault(Refuse("service handler returned None"), worked=True))
    result = pay(context, name, context.random.integer(100, 900), DEADLINE)
    context.require(
        'after an error with "handler returned", pay() calls the till again',
        holds=not result.error,
        expected="the receipt, after another attempt",
        actual=result.error,
        hints=(
            'An error that contains "handler returned" is not a refusal, because the handler may have '
            "done its work. After this error, call the till again."
        ),
    )


def _limits_each_try(context: CheckContext, name: str, till: FaultyServer, tries: int) -> None:
    """If the till is slow, assert that the client made several attempts.

    If the till responds in time, the client must make only one attempt.
    """
    context.require(
        "at the end, pay() returns the receipt",
        holds=tries > 1,
        expected=f"an attempt that ends after {TRY:g} s, and another attempt",
        actual="one attempt that waited longer",
        hints=f"A call took longer than {TRY:g} s. Pass this limit to `call_within()`.",
    )
    before = len(till.requests)
    till.plan.append(Fault(Late(A_LITTLE, {}), worked=True))
    result = pay(context, name, context.random.integer(100, 900), DEADLINE)
    tries = len(till.requests) - before
    context.require(
        "pay() does not send a successful payment again",
        holds=tries == 1 or result.took > TRY,
        expected=f"one request to a till that takes {A_LITTLE:g} s",
        actual=f"{tries} requests within {result.took:.1f} s",
        hints=(
            f"A call had a limit below {TRY:g} s, so pay() called the till again too early. Give "
            f"each call a limit of {TRY:g} s."
        ),
    )


def _pauses_grow(context: CheckContext, name: str, till: FaultyServer, books: Books) -> None:
    """Let three attempts fail, and assert that the third pause is long enough.

    If the pauses grow slowly, test their growth with more failed attempts.
    """
    before = len(till.arrivals)
    till.plan.extend([Fault(HangUp())] * 3)
    pays_after(context, name, till, books, "failing three times")
    times = till.arrivals[before:]
    pauses = [later - earlier for earlier, later in pairwise(times)]
    context.require(
        "there is a pause before the next attempt",
        holds=min(pauses) > 0.9 * PAUSE,
        expected=f"a pause of {PAUSE:g} s or more",
        actual=f"a pause of {min(pauses):.3f} s",
        hints=(
            "The pause after the first failed call was missing or too short. Sleep for 0.1 s after this call."
        ),
    )
    context.require(
        "each pause is longer than the previous pause",
        holds=pauses[2] > 3.5 * PAUSE,
        expected=f"a pause of {4 * PAUSE:g} s before the fourth attempt",
        actual=f"{pauses[2]:.2f} s",
        hints=SLOW_GROWTH,
    )
    # If the pauses grow slowly, up to `MOST` attempts can fail before the deadline.
    if pauses[2] < 8 * PAUSE:
        before = len(till.arrivals)
        till.plan.extend([Fault(HangUp())] * MOST)
        pays_after(context, name, till, books, f"failing {MOST} times", LONG)
        *_, previous, pause = (b - a for a, b in pairwise(till.arrivals[before : before + MOST + 1]))
        longest = 2 ** (MOST - 1) * PAUSE
        context.require(
            "each pause is longer than the previous pause",
            holds=pause > 0.95 * longest,
            expected=f"a pause of {longest:g} s before attempt {MOST + 1}",
            actual=f"{pause:.2f} s",
            hints=LIMITED if pause < 1.5 * previous else SLOW_GROWTH,
        )


def _gives_up(context: CheckContext, name: str, till: FaultyServer) -> None:
    till.plan.extend([Fault(Silence())] * 100)
    result = pay(context, name, context.random.integer(100, 900), SHORT, GIVEN_UP)
    context.expect(
        "pay() returns None when the deadline has passed",
        expected=None,
        actual=result.returned(),
        hints=UNKNOWN,
    )
    context.require(
        "pay() ends at the deadline",
        holds=result.took < SHORT + SLACK,
        expected=f"pay() ends after {SHORT:g} s or slightly more",
        actual=f"pay() ended after {result.took:.1f} s",
        hints=(
            "pay() was still running after the deadline. Check the remaining time before each call and "
            "before each pause."
        ),
    )
    context.require(
        "pay() makes attempts until the deadline",
        holds=result.took > SHORT / 3,
        expected=f"attempts for {SHORT:g} s",
        actual=f"pay() ended after {result.took:.1f} s",
    )
    till.plan.clear()


def _keeps_the_deadline(context: CheckContext, name: str, till: FaultyServer) -> None:
    """Let the till respond after the deadline, but within the time limit of an attempt (0.5 s).

    The check repeats the payment until one payment ends in time, because the machine may be busy.
    """
    returned: list[Json] = []

    def is_kept() -> bool:
        till.plan.append(Fault(Late(0.3, {}), worked=True))
        returned.append(pay(context, name, context.random.integer(100, 900), 0.05, GIVEN_UP).returned())
        till.plan.clear()
        return returned[-1] is None

    wait_until(is_kept, KEEPING)
    context.expect(
        "pay() ends at the deadline",
        expected=None,
        actual=returned[-1],
        hints=(
            "The deadline was 0.05 s, but pay() waited 0.3 s for the till. Limit each call to the "
            "remaining time."
        ),
    )
