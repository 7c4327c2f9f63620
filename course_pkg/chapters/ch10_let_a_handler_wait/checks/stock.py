"""10.4: a handler that runs in fifty threads at the same time."""

from __future__ import annotations

from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_in_kernel import (
    CALLERS,
    KERNEL_CODE,
    MANY,
    ONE,
    SHELF_ERRORS,
    TRIGGER,
    CheckedShelf,
)
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.kernel.slow_lines import SLOW_LINES
from course_pkg.checking.peers.service_calls import Service

STUCK = (
    "A client waits forever, because a thread does not release the lock. Use `with`, and do not "
    "acquire the lock twice in the same thread."
)
ERRORS = [
    *SHELF_ERRORS,
    (matches("TimesUp"), STUCK),
    (
        matches("cannot process request: '?b?'?sold out"),
        (
            '"Sold out" is a normal response, not an error. Return success=False instead of raising '
            "an exception."
        ),
    ),
    (
        matches("has no attribute 'lock'"),
        (
            "The attribute self.lock does not exist. Create the lock once in __init__, and store it in "
            "self.lock."
        ),
    ),
]
TWICE = (
    "Two handlers read the same number, so too many things were sold. In all calls, hold the same lock, "
    "such as a threading.Lock, while you read, decide and write."
)
REREAD = (
    "Two clients got the same number of things that are left. Read the shelf only while you hold the lock, "
    "and calculate the message from this number."
)
ONE_BY_ONE = (
    "The handlers never ran at the same time, because your code has changed rospy or a module of Python. "
    "Remove this change, and protect the shelf with a lock in your class."
)
EMPTIED = 'Sell the things to one client after the other. When the shelf is empty, respond with "sold out".'


@part(
    "10.4",
    points=2,
    goal=(
        "Sell the things on a shelf to 50 clients at the same time. Sell each thing only once. When the "
        'shelf is empty, respond with "sold out".'
    ),
    needs=["Stock"],
    deadline=60.0,
    goals=[EMPTIED, "Sell each thing only once, even if 50 clients call at the same time."],
)
def safe_with_fifty_clients(context: CheckContext) -> None:
    """Take all things from a small shelf with single calls; then make fifty simultaneous calls."""
    name = f"/{context.random.word()}"
    context.prepare(KERNEL_CODE + SLOW_LINES)
    few = context.random.integer(2, 4)
    take = _opened(context, name, CheckedShelf(few), ONE)
    try:
        for left in [*range(few - 1, -1, -1), None, None]:
            _takes_one(context, take, left)
    finally:
        context.run("checked_shop.close")
    context.fulfilled(EMPTIED)
    count = context.random.integer(28, 36)
    shelf = CheckedShelf(count)
    take = _opened(context, name, shelf, MANY)
    try:
        _takes_all(context, take, shelf, count)
        shelf.things = few
        _sells_what_comes_later(context, take, few)
    finally:
        context.run("slow_lines.end")
        context.run("checked_shop.close")


def _opened(context: CheckContext, name: str, shelf: CheckedShelf, timeout: float) -> Service:
    services = {name: "handle_take"}
    context.place("checked_shelf", shelf)
    opened = context.run(
        "checked_shop.open",
        Its("Stock"),
        Its("checked_shelf"),
        services,
        worded=f"Stock(shelf) with {shelf.things} things on the shelf",
    )
    context.require("a Stock can be created with a shelf", holds=not opened.error, actual=opened.error)
    return context.service(name, TRIGGER, hints=ERRORS, timeout=timeout)


def _sells_what_comes_later(context: CheckContext, take: Service, things: int) -> None:
    """Put new things on the shelf, and then take one thing; `things` is the number of new things."""
    context.expect(
        'the message is the number of things that are left, or "sold out"',
        expected=str(things - 1),
        actual=take().message,
        hints=(
            "New things were put on the shelf, but the handler did not notice them. In each call, read the "
            "number from the shelf."
        ),
    )


def _takes_one(context: CheckContext, take: Service, left: int | None) -> None:
    """Take a thing; `left` is the number of things after this call, or None if the shelf was empty."""
    seen = take()
    context.expect(
        "the field `success` is True only if the shelf was not empty",
        expected=left is not None,
        actual=seen.success,
        hints=[
            (
                True,
                (
                    "The shelf was empty, but `success` is True. Check the number of things before "
                    "you sell a thing."
                ),
            ),
            (
                False,
                (
                    "The shelf was not empty, but `success` has its default value, False. Set `success` to "
                    "True."
                ),
            ),
        ],
    )
    context.expect(
        'the message is the number of things that are left, or "sold out"',
        expected="sold out" if left is None else str(left),
        actual=seen.message,
        hints=[
            (
                "",
                ("The message is empty. Set the message to the number of things that are left, as a string."),
            ),
            (
                str((left or 0) + 1),
                "The message is the number before the sale. Return the number after the sale.",
            ),
            (
                ANYTHING,
                (
                    'The message is wrong. Return the number of things that are left, such as "7", or '
                    'the text "sold out".'
                ),
            ),
        ],
    )


def _wrong_number_sold(count: int) -> Hints:
    return [
        ((lambda actual: actual > count), TWICE),
        (
            (lambda actual: actual < count),
            (
                "The shelf was not empty, but a client got nothing. If another thread holds the lock, "
                "let the handler wait for the lock."
            ),
        ),
    ]


def _takes_all(context: CheckContext, take: Service, shelf: CheckedShelf, count: int) -> None:
    shelf.await_crowd()
    context.run("slow_lines.begin")
    replies = [reply.response for reply in take.at_once([{}] * CALLERS)]
    sold = [reply.message for reply in replies if reply.success]
    if not shelf.together:
        context.fail(
            f"{CALLERS} clients at the same time: the number of sales is equal to the number of things",
            expected="several handlers run at the same time",
            actual="the handlers run one after the other",
            hint=ONE_BY_ONE,
        )
    context.expect(
        f"{CALLERS} clients at the same time: the number of sales is equal to the number of things",
        expected=count,
        actual=len(sold),
        hints=_wrong_number_sold(count),
    )
    context.require(
        f"{CALLERS} clients at the same time: each client gets a different thing",
        holds=sorted(sold) == sorted(map(str, range(count))),
        expected="each number of remaining things, exactly once",
        actual=", ".join(sorted({message for message in sold if sold.count(message) > 1})),
        hints=REREAD,
    )
    context.expect(
        "the shelf contains the number of things that were not sold",
        expected=0,
        actual=shelf.things,
        hints=(
            "The number on the shelf is wrong. After each sale, call write() of the shelf with the "
            "number of remaining things."
        ),
    )
