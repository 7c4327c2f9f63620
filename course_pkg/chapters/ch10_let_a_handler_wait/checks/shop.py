"""10.5: a server that calls another server while it serves its own clients."""

from __future__ import annotations

from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_crowd import ANOTHER_NUMBER, sells_to_fifty
from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_in_kernel import (
    KERNEL_CODE,
    MANY,
    ONE,
    SHELF_ERRORS,
    TRIGGER,
    CheckedShelf,
)
from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_till import Till
from course_pkg.checking import ANYTHING, CheckContext, Its, Refuse, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import Act, HangUp
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.result import Result

CHARGE = "course_pkg/Charge"
ABSENT = 4.0  # If no till runs, a sale may take up to this time in s on a busy machine.
LOCKED = (
    "Your handler holds the lock while it calls the till, so /left cannot respond. Release the lock "
    "before you call the till's service."
)
STUCK = (
    "A client waits forever, because a lock was not released. Use `with`, which releases the lock "
    "in every case."
)
ERRORS = [*SHELF_ERRORS, (matches("TimesUp"), STUCK)]
SOLD_OUT = (
    '"Sold out" is a normal response of /buy, not an error. Return success=False instead of '
    "raising an exception."
)
NOT_CAUGHT = (
    "The call of the till failed, and the exception ended your handler. Catch "
    "rospy.ServiceException, put the thing back, and return success=False."
)

NO_TILL = (
    "No server offers the till's service, but the handler waits for this service without a time limit. "
    "Call the service immediately: without a server, the call raises rospy.ServiceException."
)
AGAIN = (
    "The call of the till failed, and your handler called the till again. Call the till only once: the "
    "client decides whether to try again."
)

SOLD = "Sell one thing, and do not hold the lock while you call the till's service."
PUT_BACK = "Put the thing back if the call of the till's service fails."


@part(
    "10.5",
    points=3,
    goal=(
        "Sell a thing for money. Hold the lock while you take the thing from the shelf, but not while "
        "you call the till's service. Put the thing back if the call of the till's service fails."
    ),
    needs=["Shop"],
    deadline=60.0,
    goals=[SOLD, PUT_BACK, "Sell to 50 clients at the same time."],
)
def no_lock_across_a_call(context: CheckContext) -> None:
    """Buy from the student's shop while the till behaves in different ways.

    While the till handles its first call, it calls /left; later, it refuses or fails. At the end, 50 threads
    buy at the same time.
    """
    buy, left, charge = (f"/{context.random.word()}" for _ in range(3))
    cents = context.random.integer(100, 900)
    count = context.random.integer(28, 36)
    shelf = CheckedShelf(count)
    till = Till(context, left, shelf)
    context.prepare(KERNEL_CODE)
    context.serve(charge, CHARGE, till)
    services = {buy: "handle_buy", left: "handle_left"}
    worded = f"Shop(shelf, {cents}, the till) with {count} things on the shelf"
    opened = _opened(context, shelf, services, cents, charge, worded)
    context.require(
        "a Shop can be created from a shelf, a price and the name of a till",
        holds=not opened.error,
        actual=opened.error,
    )
    try:
        failed = [(matches("sold out"), SOLD_OUT), (matches("process request"), NOT_CAUGHT), *ERRORS]
        buying = context.service(buy, TRIGGER, hints=failed, timeout=MANY)
        looking = context.service(left, TRIGGER, hints=ERRORS, timeout=ONE)
        _sells(context, buying, till, cents, count)
        context.fulfilled(SOLD)
        _fails_to_sell(context, buying, looking, till, count - 1)
        context.fulfilled(PUT_BACK)
        sells_to_fifty(context, buying, looking, till, shelf, count - 1)
    finally:
        context.run("checked_shop.close")
    _creates_other_ids(context, services, cents, charge, till)
    _has_no_till(context, cents)


def _opened(
    context: CheckContext,
    shelf: CheckedShelf,
    services: dict[str, str],
    cents: int,
    charge: str,
    worded: str,
) -> Result:
    context.place("checked_shelf", shelf)
    its = Its("Shop"), Its("checked_shelf")
    return context.run("checked_shop.open", *its, services, cents, charge, worded=worded)


def _creates_other_ids(
    context: CheckContext, services: dict[str, str], cents: int, charge: str, till: Till
) -> None:
    """Buy in a second shop with the same till, and assert that the request_id is new."""
    known = till.ids.copy()
    till.acts.clear()
    _opened(context, CheckedShelf(2), services, cents, charge, "Shop(shelf, cents, till)")
    try:
        context.service(next(iter(services)), TRIGGER, hints=ERRORS, timeout=ONE)()
        if till.ids[-1] in known:
            context.fail(
                "a purchase in a second shop has its own request_id",
                expected="a request_id that the first shop has not used",
                actual=till.ids[-1],
                hint=(
                    "Two Shop objects created the same request_id, because each object counts from the "
                    "beginning. Create each id with uuid.uuid4()."
                ),
            )
    finally:
        context.run("checked_shop.close")


def _has_no_till(context: CheckContext, cents: int) -> None:
    """Buy in a shop without a running till, so that the shop's call to the till fails immediately."""
    buy, left, charge = (f"/{context.random.word()}" for _ in range(3))
    count = context.random.integer(2, 9)
    services = {buy: "handle_buy", left: "handle_left"}
    _opened(context, CheckedShelf(count), services, cents, charge, "Shop(shelf, cents, till)")
    context.run("checked_shop.count_calls", charge)
    try:
        failed = [(matches("TimesUp"), NO_TILL), (matches("process request"), NOT_CAUGHT)]
        response = context.service(buy, TRIGGER, hints=failed, timeout=ABSENT)()
        context.require(
            "the shop sells nothing if the call of the till fails",
            holds=not response.success and bool(response.message),
            expected="success=False and a message, because the till does not run",
            actual=response,
            hints=(
                "No server offers the till's service, so the client did not pay. Return success=False, "
                "and the text of the error as the message."
            ),
        )
        context.require(
            "the shop sells nothing if the call of the till fails",
            holds=context.read("checked_shop.calls", int) <= 1,
            expected="one call",
            actual="several calls",
            hints=AGAIN,
        )
        context.expect(
            "after a failed payment, the thing is on the shelf again",
            expected=str(count),
            actual=context.service(left, TRIGGER, hints=ERRORS, timeout=ONE)().message,
            hints=(
                "No server offers the till's service, so the thing is not sold. Put the thing back on "
                "the shelf while you hold the lock."
            ),
        )
    finally:
        context.run("checked_shop.close")


NOT_CHARGED_ONCE: Hints = [
    ([], "The till was not called. Call the service whose name is in self.till."),
    (
        ANYTHING,
        ("The till was called with a wrong amount, or more than once. Call the till once, with self.cents."),
    ),
]


def _not_reserved(count: int) -> Hints:
    return [
        (
            str(count),
            (
                "While the till is working, the thing is still on the shelf, so another client can buy "
                "it. Take the thing from the shelf before you call the till."
            ),
        ),
        (
            ANYTHING,
            ("The message of /left is wrong. Return only the number of things on the shelf, as a string."),
        ),
    ]


NOT_SOLD: Hints = [
    (matches("False"), "The till has taken the money, but `success` is False. Set `success` to True."),
    (ANYTHING, "The message of /buy is wrong. Return the number of the receipt, as a string."),
]


def _sells(context: CheckContext, buying: Service, till: Till, cents: int, count: int) -> None:
    response = buying()
    context.expect(
        "the shop calls the till once, with the price",
        expected=[cents],
        actual=till.charged,
        hints=NOT_CHARGED_ONCE,
    )
    context.require(
        "the request to the till contains a request_id",
        holds=bool(till.ids[0]),
        expected="a request_id",
        actual="an empty value",
        hints="The field `request_id` is empty. Create a new id for each purchase with uuid.uuid4().",
    )
    context.require(
        "/left responds while the till is working",
        holds=till.answers[0] not in ("CallTimeout",),
        expected="a response of /left before the till responds",
        actual="no response within 2 s",
        hints=LOCKED,
    )
    context.expect(
        "during a payment, the thing is not on the shelf",
        expected=str(count - 1),
        actual=till.answers[0],
        hints=_not_reserved(count),
    )
    context.expect(
        "during a payment, the thing is not on the shelf",
        expected=count - 1,
        actual=till.on_shelf[0],
        hints=ANOTHER_NUMBER,
    )
    context.expect(
        "a client that has paid gets the number of the receipt",
        expected=[True, str(till.offset + 1)],
        actual=[response.success, response.message],
        hints=NOT_SOLD,
    )


def _fails_to_sell(context: CheckContext, buying: Service, looking: Service, till: Till, count: int) -> None:
    acts: list[Act | None] = [Refuse("no money on this card"), HangUp()]
    for act in context.random.shuffled(acts):
        till.acts, before = [act], len(till.ids)
        response = buying()
        asked = len(till.ids) - before
        context.expect(
            "the shop sells nothing if the call of the till fails",
            expected=False,
            actual=response.success,
            hints=(
                "The till did not take the money, but `success` is True. If the call of the till "
                "fails, return success=False."
            )
            if asked == 1
            else AGAIN,
        )
        context.require(
            "the shop sells nothing if the call of the till fails",
            holds=bool(response.message),
            expected="a message with the reason",
            actual="an empty value",
            hints=(
                "The message is empty. If the call of the till fails, return the text of the error, "
                "str(error), as the message."
            ),
        )
        context.expect(
            "after a failed payment, the thing is on the shelf again",
            expected=str(count),
            actual=looking().message,
            hints=[
                (
                    str(count - 1),
                    (
                        "The call of the till failed, but the thing is not on the shelf again. Put the thing "
                        "back while you hold the lock."
                    ),
                ),
            ],
        )
