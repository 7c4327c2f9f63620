"""10.5: 50 clients that buy from the student's shop at the same time."""

from __future__ import annotations

from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_in_kernel import CALLERS, CheckedShelf
from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_till import Till
from course_pkg.checking import CheckContext, Refuse
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.request_ids import from_a_counter

SERIAL = (
    "The till received only a few calls at the same time, because your handler holds a lock or a "
    "semaphore during the call. Release the lock or semaphore before you call the till's service."
)
TORN = (
    "Another thread changed the shelf between your call of read() and your call of write(). Hold the "
    "same lock during both calls, and also read the shelf again before you put a thing back."
)
ANOTHER_NUMBER = (
    "The number on the shelf is different from the number that /left returns. Use the methods "
    "read() and write(count) of the shelf, and do not replace these methods."
)


def sells_to_fifty(
    context: CheckContext, buying: Service, looking: Service, till: Till, shelf: CheckedShelf, count: int
) -> None:
    """Let 50 clients buy at the same time; the till refuses five of their payments.

    `count` is the number of things on the shelf.
    """
    till.charged.clear()
    till.acts = [Refuse("no money on this card")] * 5
    shelf.await_crowd()
    till.await_crowd()
    replies = [reply.response for reply in buying.at_once([{}] * CALLERS)]
    sold = sum(reply.success for reply in replies)
    context.expect(
        f"{CALLERS} clients at the same time: the till charges once for each sale",
        expected=sold,
        actual=len(till.charged),
    )
    context.require(
        f"{CALLERS} clients at the same time: the till charges once for each sale",
        holds=till.together >= till.crowd,
        expected="all clients can pay at the same time",
        actual=f"at most {till.together} clients at the same time",
        hints=SERIAL,
    )
    context.require(
        f"{CALLERS} clients at the same time: each purchase has its own request_id",
        holds=len(set(till.ids)) == len(till.ids),
        expected="a different id for each purchase",
        actual="the same id twice",
        hints=(
            "Two purchases have the same request_id. In the handler, create a new request_id for each call."
        ),
    )
    context.require(
        f"{CALLERS} clients at the same time: each purchase has its own request_id",
        holds=not from_a_counter(till.ids),
        expected="ids that no other program creates",
        actual=", ".join(till.ids[:3]),
        hints=(
            "The ids come from a counter, so another program, or this program after a restart, can "
            "create the same ids. Create each id with uuid.uuid4()."
        ),
    )
    refusals = [reply.message for reply in replies if not reply.success and reply.message != "sold out"]
    _sells_no_more_than_there_is(context, sold, count, refusals, 5 - len(till.acts))
    context.expect(
        f"{CALLERS} clients at the same time: the number of things on the shelf is right",
        expected=str(count - sold),
        actual=looking().message,
        hints=TORN,
    )
    context.expect(
        f"{CALLERS} clients at the same time: the number of things on the shelf is right",
        expected=count - sold,
        actual=shelf.things,
        hints=ANOTHER_NUMBER,
    )


def _sells_no_more_than_there_is(
    context: CheckContext, sold: int, count: int, refusals: list[str], unpaid: int
) -> None:
    context.require(
        f"{CALLERS} clients at the same time: the shop sells only the things that it has",
        holds=sold <= count,
        expected=f"at most {count} sales",
        actual=sold,
        hints=TORN,
    )
    context.require(
        f"{CALLERS} clients at the same time: the shop sells only the things that it has",
        holds=len(refusals) <= unpaid,
        expected='"sold out" if the shelf is empty',
        actual=max(refusals, key=refusals.count, default=""),
        hints=(
            "The shelf is empty, but the handler did not report this. Return success=False and the "
            'message "sold out".'
        ),
    )
