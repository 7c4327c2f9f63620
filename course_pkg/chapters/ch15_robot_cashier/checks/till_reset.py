"""15.9: a till that can be reset."""

from __future__ import annotations

import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.till import (
    ANSWER,
    NAME,
    RESET,
    TILL_TOTAL,
    TOTAL,
    TRIGGER,
    TWICE,
    Till,
    random_items,
    refuses_illegal_items,
    running_till,
    totals,
)
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.service_calls import Service

HOLDING = 0.4  # While a reset waits, the printing of a line takes this time in s.
EMPTIED = "Remove all items, and return the sum that was paid."

SUCCEEDS = "The field `success` is False, but a reset always succeeds. Set this field to True."
PAID = 'The message is wrong. Write "paid", the sum of all items and "cents", such as "paid 460 cents".'
EMPTY = 'The till has no items, so the message has to be "already empty". Set the field `success` to True.'
FREE_ITEM = (
    "The till has an item that costs 0 cents, so it is not empty. Check the number of items, not the sum."
)
KEPT = (
    "After a reset, till/total still counts the previous customer's items. In the handler of till/reset, "
    "remove all items, and set a stored total to 0."
)
NOT_COUNTED = (
    "The reset came while the printer was printing an item, but the sum does not contain this item. In "
    "the handler of till/reset, acquire the lock of till/set before you calculate the sum."
)
TOO_EARLY = (
    "The handler of till/reset did not wait until the line was printed. Use the same lock in the "
    "handlers of till/set and till/reset."
)
LEFT = (
    "The reset came while the printer was printing an item, and this item was in the till after the "
    "reset. Hold one lock while you print the line and store the price."
)


@part(
    "15.9",
    points=2,
    goal="Extend till.py: till/reset removes all items, and returns a message with the sum that was paid.",
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME, "# Copy your program of exercise 15.8 into this cell, and extend the copy.\n..."),
    goals={
        EMPTIED: 3,
        (
            "If the printer is printing a line, wait until the line is printed. Reset the till even if "
            "there is no printer."
        ): 1,
    },
)
def the_reset(context: CheckContext) -> None:
    """Reset a till with items, a till without items, and a till with an item that costs 0 cents.

    Later, call till/reset while a line is being printed, and after the printer has ended.
    """
    with running_till(context, TOTAL, RESET) as till:
        total = till.service(context, TOTAL, TILL_TOTAL)
        reset = till.service(context, RESET, TRIGGER, [(ANYTHING, SUCCEEDS)])
        _resets(context, reset, "already empty", EMPTY)
        items = random_items(context, 2)
        paid = sum(cents for _, cents in items)
        old = items[1][1]  # The first item has this price at first, and later its price in `items`.
        for item, cents in ((items[0][0], old), *items):
            till.set(item=item, cents=cents)
        _resets(context, reset, f"paid {paid} cents", [(f"paid {paid + old} cents", TWICE), (ANYTHING, PAID)])
        totals(context, total, {}, KEPT, KEPT)
        _resets(context, reset, "already empty", EMPTY)
        till.set(item=items[0][0], cents=0)
        _resets(context, reset, "paid 0 cents", FREE_ITEM)
        context.fulfilled(EMPTIED)
        refuses_illegal_items(context, till)
        _waits_for_a_line(context, till, reset, total)
        till.set(item=items[0][0], cents=items[0][1])
        till.server.leave()
        _resets(context, reset, f"paid {items[0][1]} cents", PAID)


def _resets(context: CheckContext, reset: Service, message: str, hint: Hints) -> None:
    response = reset()
    context.expect("a reset succeeds", expected=True, actual=response.success, hints=SUCCEEDS)
    context.expect("the message of a reset is right", expected=message, actual=response.message, hints=hint)


def _waits_for_a_line(context: CheckContext, till: Till, reset: Service, total: Service) -> None:
    """Call till/reset during the printing of a line."""
    first, second = random_items(context, 2)
    till.set(item=first[0], cents=first[1])
    till.printer.began.clear()
    till.printer.held.clear()
    release = threading.Timer(HOLDING, till.printer.held.set)
    with ThreadPoolExecutor(1) as pool:
        setting: Future[list[object]] = pool.submit(
            lambda: [each.response for each in till.set.at_once([{"item": second[0], "cents": second[1]}])]
        )
        till.printer.began.wait(ANSWER)
        release.start()
        started = time.monotonic()
        response = reset()
        waited = time.monotonic() - started
        setting.result()
    context.require(
        "a reset waits until the current line is printed",
        holds=waited > HOLDING - 0.1,
        expected="a response after the line was printed",
        actual="a response before the line was printed",
        hints=TOO_EARLY,
    )
    context.expect(
        "the paid sum contains the cents of this item",
        expected=f"paid {first[1] + second[1]} cents",
        actual=response.message,
        hints=NOT_COUNTED,
    )
    totals(context, total, {}, LEFT, LEFT)
