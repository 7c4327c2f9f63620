"""12.2: a server that must charge a repeated request only once."""

from __future__ import annotations

from course_pkg.chapters.ch12_survive_trouble.checks.payments import CHARGE
from course_pkg.chapters.ch12_survive_trouble.checks.simultaneous_requests import (
    charges_each_once,
    gives_different_receipts,
)
from course_pkg.chapters.ch12_survive_trouble.checks.till_in_kernel import (
    KERNEL_CODE,
    CheckedPurse,
    opened_till,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import REFUSED_BY_HANDLER
from course_pkg.checking.peers.service_calls import Service

ONE = 6.0  # ONE is the time limit in s for a single call.
MANY = 20.0  # MANY is the time limit in s for 50 simultaneous calls on a busy machine.
AGAIN = (
    "The till charged the same request twice. Store the receipt under its request_id, and look for "
    "a stored receipt before you take money."
)
TOO_SOON = (
    "A request failed, and the client sent it again, but the till did not charge it. Store the "
    "request_id only after `take()` has returned."
)
REFUSED = "The till refused a repeated request. The first response was lost, so send the same receipt again."
ONLY_TAKE = (
    "Your code uses a method that a purse does not have. Use only take(cents), and count the receipts "
    "in your own class."
)
ANOTHER_TILL = (
    "A second Till object used the receipts of the first Till object, so the till treated a new "
    "request as a repetition. Create the dict in __init__, and store it in self."
)
NOTHING = "The handler returned None. Return a ChargeResponse in every case."
STUCK = (
    "After an error of the purse, no client gets a response, because the lock was not released. Use "
    "`with self.lock:`, which releases the lock after an error."
)
CHARGED = "Charge a new request. If the same request comes again, send the same receipt."
FAILED = (
    "If the purse raises an error, try the payment again when the client repeats the request. "
    "Refuse a request without an id."
)


@part(
    "12.2",
    points=2,
    goal=("Charge each request only once, even if the request comes again. Send the same receipt each time."),
    needs=["Till"],
    deadline=60.0,
    goals={
        CHARGED: 2,
        FAILED: 1,
        "Charge each request only once, even if 50 calls come at the same time.": 1,
    },
)
def charge_once(context: CheckContext) -> None:
    """Send new and repeated requests, requests for which the purse fails, and a request without an id.

    Later, send 50 requests at the same time.
    """
    name = f"/{context.random.word()}"
    context.prepare(KERNEL_CODE)
    purse, opened = opened_till(context, name)
    context.require("a Till can be created with a purse", holds=not opened.error, actual=opened.error)
    hints = [
        (matches("Purse' object has no attribute"), ONLY_TAKE),
        (matches("TimesUp"), STUCK),
        (matches("returned None"), NOTHING),
        (matches("cannot process request"), REFUSED),
    ]
    charge = context.service(name, CHARGE, hints=hints, timeout=ONE)
    crowd = context.service(name, CHARGE, hints=hints, timeout=MANY)
    try:
        known = _charges_new_requests(context, purse, charge)
        context.fulfilled(CHARGED)
        _fails_once(context, purse, charge)
        _refuses_without_an_id(context, charge)
        context.fulfilled(FAILED)
        charges_each_once(context, purse, crowd)
        gives_different_receipts(context, purse, crowd)
        _remembers(context, charge, *known)
    finally:
        context.run("checked_desk.close")
    _is_new_to_another_till(context, hints, known[0])


ANOTHER_RECEIPT: Hints = [
    (
        0,
        (
            "The receipt is 0, which is the default of the field. Store the first receipt, and send it for "
            "each repetition."
        ),
    ),
    (
        ANYTHING,
        (
            "The repeated request got a different receipt. Store the first receipt under the "
            "request_id, and send it for each repetition."
        ),
    ),
]


def _charges_new_requests(context: CheckContext, purse: CheckedPurse, charge: Service) -> tuple[str, int]:
    """Send new requests and repeat them; return the id and the receipt of a charged request."""
    cents = context.random.integer(100, 900)
    first = context.random.word(12)
    second = first.upper()  # Upper-case and lower-case letters are different in an id.
    receipt = charge(request_id=first, cents=cents).receipt
    _purse_has(
        context,
        purse,
        "the till charges a new request",
        [cents],
        [([], "The till did not take money. Call self.purse.take() with the cents of the request.")],
    )
    other = charge(request_id=second, cents=cents).receipt
    _purse_has(
        context,
        purse,
        "the till charges another request, even if the amount is the same",
        [cents, cents],
        _only_one(
            "Two customers may pay the same amount. Compare only the request_id to find out whether "
            "a request is a repetition."
        ),
    )
    context.require(
        "another request gets a different receipt",
        holds=other != receipt,
        expected="two different receipts",
        actual=f"the receipt {receipt} for both requests",
        hints=(
            "Two purchases got the same receipt. Give each purchase a new number, for example from a counter."
        ),
    )
    for again, before in ((first, receipt), (second, other), (first, receipt)):
        repeated = charge(request_id=again, cents=context.random.integer(100, 900)).receipt
        _purse_has(context, purse, "the till does not charge a repeated request again", [cents, cents], AGAIN)
        context.expect(
            "a repeated request gets the same receipt again",
            expected=before,
            actual=repeated,
            hints=ANOTHER_RECEIPT,
        )
    return first, receipt


def _only_one(words: str) -> Hints:
    """Return a list with the hint `words`; this hint is shown if the purse was used at most once."""
    return [((lambda actual: len(actual) < 2), words)]


def _fails_once(context: CheckContext, purse: CheckedPurse, charge: Service) -> None:
    request_id, cents = context.random.word(12), context.random.integer(1000, 1900)
    purse.stuck = True
    charge.refused(
        "if the purse fails, the client gets an error",
        request_id=request_id,
        cents=cents,
        hints=(
            "The purse raised an error, but the client got a receipt. Do not catch this error, "
            "because rospy sends it to the client."
        ),
    )
    charge(request_id=request_id, cents=cents)
    _purse_ends_with(
        context, purse, "the till charges a failed request when the client sends it again", cents, TOO_SOON
    )
    _fails_for_twins(context, purse, charge)


def _fails_for_twins(context: CheckContext, purse: CheckedPurse, charge: Service) -> None:
    """Send the same request twice at the same time; one call of take() fails.

    A till that returns a receipt must have charged the request exactly once.

    If both requests share one call of take(), both clients get an error.
    """
    before, cents = len(purse.took), context.random.integer(10_000, 19_000)
    purse.stuck = True
    purse.await_crowd()
    replies = charge.replies([{"request_id": context.random.word(12), "cents": cents}] * 2)
    charged = len(purse.took) - before
    context.require(
        "the till charges a failed request when the client sends it again",
        holds=charged == 1 or all(reply.error for reply in replies),
        expected="a receipt, and one charge",
        actual=f"a receipt, and {charged} charges",
        hints=TOO_SOON,
    )
    purse.stuck = False


NOT_REFUSED: Hints = [
    (
        matches("returned None"),
        "The handler returned None for an empty id. Raise rospy.ServiceException with an error message.",
    ),
    (
        matches("error processing"),
        "For an empty id, the handler raised an exception of the wrong type. Raise rospy.ServiceException.",
    ),
    (
        ANYTHING,
        (
            "A request with an empty id got a receipt. Raise rospy.ServiceException, because the till "
            "cannot recognise a repetition without an id."
        ),
    ),
]


def _refuses_without_an_id(context: CheckContext, charge: Service) -> None:
    label = "the till refuses a request without an id"
    error = charge.refused(label, request_id="", cents=context.random.integer(2000, 2900), hints=NOT_REFUSED)
    context.require(
        label,
        holds=bool(REFUSED_BY_HANDLER.search(error)),
        expected="service cannot process request: …, and then your error message",
        actual=error,
        hints=NOT_REFUSED,
    )


def _remembers(context: CheckContext, charge: Service, request_id: str, receipt: int) -> None:
    """Repeat the first request after all other requests."""
    context.expect(
        "a repeated request gets the same receipt again",
        expected=receipt,
        actual=charge(request_id=request_id, cents=context.random.integer(100, 900)).receipt,
        hints=ANOTHER_RECEIPT,
    )


def _is_new_to_another_till(context: CheckContext, hints: Hints, request_id: str) -> None:
    name, cents = f"/{context.random.word()}", context.random.integer(100, 900)
    purse, _ = opened_till(context, name)
    try:
        context.service(name, CHARGE, hints=hints, timeout=ONE)(request_id=request_id, cents=cents)
        _purse_has(context, purse, "the till charges a new request", [cents], ANOTHER_TILL)
    finally:
        context.run("checked_desk.close")


def _purse_has(
    context: CheckContext, purse: CheckedPurse, assertion: str, expected: list[int], hints: Hints
) -> None:
    context.expect(assertion, expected=expected, actual=list(purse.took), hints=hints)


def _purse_ends_with(
    context: CheckContext, purse: CheckedPurse, assertion: str, cents: int, hint: str
) -> None:
    context.expect(assertion, expected=cents, actual=purse.took[-1] if purse.took else None, hints=hint)
