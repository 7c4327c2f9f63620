"""15.7, 15.8 and 15.9: a till that prints each item, adds its price, and can be reset."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, student_node
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.peers.service_calls import Service

NAME = "till"
SET, TOTAL, RESET, PRINT = "till/set", "till/total", "till/reset", "print_line"
TILL_SET, TILL_TOTAL, TRIGGER, PRINT_LINE = (
    "course_pkg/TillSet",
    "course_pkg/TillTotal",
    "std_srvs/Trigger",
    "course_pkg/PrintLine",
)
MANY = 8
ANSWER = 5.0  # A call may take up to this time in s.
HOLDING = 0.4  # While a reset waits, the printing of a line takes this time in s.

SET_HINTS: Hints = [
    (
        matches("jam"),
        (
            "The printer got two lines at the same time. Hold one lock while you print a line and "
            "store the price."
        ),
    ),
    (
        matches("out of|unavailable"),
        "The till refused an item although the printer works. Call print_line, and accept the item.",
    ),
    (
        matches("cannot process request: (?!.*handler returned)"),
        "The till refused a valid item. Accept each item that has a name and 0 cents or more.",
    ),
]
BROKEN = (
    "After a refused call, the next call got no response. Use `with`, which also releases the "
    "lock after an exception."
)


@dataclass(frozen=True)
class Till:
    """The student's till, its services, and the printer of the check."""

    space: str
    printer: Printer
    server: ScriptedServer
    set: Service

    def service(self, context: CheckContext, name: str, kind: str, hints: Hints = ()) -> Service:
        """Return a proxy for the service `name` of the till."""
        return context.service(f"{self.space}/{name}", kind, timeout=ANSWER, hints=hints)


@contextmanager
def running_till(context: CheckContext, *names: str) -> Iterator[Till]:
    """Start the student's till together with a printer of the check."""
    with student_node(context, NAME, Interface(services=[SET, *names]), calls=[PRINT]) as space:
        printer = Printer()
        server = context.serve(f"{space}/{PRINT}", PRINT_LINE, printer.answer)
        kind = context.service(f"{space}/{SET}", TILL_SET, timeout=ANSWER, hints=SET_HINTS)
        yield Till(space, printer, server, kind)


def _items(context: CheckContext, count: int) -> list[tuple[str, int]]:
    """Return items with different names; their prices are in cents."""
    cents = context.random.integers(count, 50, 900)
    return [(context.random.word(), amount) for amount in cents]


# -- 15.7

NOT_ADDED = "The total is wrong. Return the sum of the cents of all items, including the item of this call."
TWICE = (
    "The total contains the old price and the new price of an item. If a client sets the same item "
    "again, replace the old price."
)
FREE = "An item that costs 0 cents is missing. Store and count this item like all other items."
CASE = (
    "The items milk and MILK are two different items. Do not convert the names to small or capital letters."
)
COUNT = "The field `items` is wrong. Return the number of different items."
SUM = (
    "The field `cents` of till/total is wrong. Return the same sum as the total in the last response of "
    "till/set."
)
NEGATIVE = "The till accepted negative cents. Raise rospy.ServiceException in this case."
NEGATIVE_TEXT = (
    "The error message is not complete. Write the name of the item and the cents into the message."
)
NAMELESS = "The till accepted an item with an empty name. Raise rospy.ServiceException in this case."
CHANGED = (
    "The till refused the call, but the stored items have changed. Check the request before you "
    "store the price."
)
BIG = (
    "The till returned a wrong sum when the sum was above 2147483647. Do not convert the numbers "
    "to another type, because an int in Python has no limit."
)
SUMMED = "Store the price of each item, and return the sum of all prices."
EMPTIED = "Remove all items, and return the sum that was paid."
PRINTED = "Print one line for each item, and store the price only after the line was printed."


@part(
    "15.7",
    points=2,
    goal=(
        "Write till.py: till/set stores the price of an item, and till/total returns the sum of all prices."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME),
    goals={SUMMED: 3, "Refuse negative cents. Write the item and the cents into the error message.": 1},
)
def the_sum(context: CheckContext) -> None:
    """Send items to the till, send some of them again, and send items that the till must refuse."""
    with running_till(context, TOTAL) as till:
        total = till.service(context, TOTAL, TILL_TOTAL)
        _totals(context, total, {}, COUNT, SUM)
        prices: dict[str, int] = {}
        items = _items(context, 4)
        for item, cents, hint in (
            (*items[0], NOT_ADDED),
            (*items[1], NOT_ADDED),
            (items[0][0], items[2][1], TWICE),
            (items[1][0], items[1][1], TWICE),
            (items[3][0], 0, FREE),
            (items[0][0].upper(), items[3][1], CASE),
            (items[2][0], 3_000_000_000, BIG),
        ):
            prices[item] = cents
            _sets(context, till, item, cents, sum(prices.values()), hint)
            _totals(context, total, prices, FREE if not cents else COUNT, SUM)
        for item, cents in _items(context, context.random.integer(40, 60)):
            prices[item] = cents
            _sets(context, till, item, cents, sum(prices.values()), NOT_ADDED)
        _totals(context, total, prices, COUNT, SUM)
        context.fulfilled(SUMMED)
        amount = -context.random.integer(1, 900)
        item = context.random.word()
        for word in (str(amount), item):
            refused(
                context,
                till.set,
                "the till refuses negative cents, and the error message contains the item and the cents",
                word,
                item=item,
                cents=amount,
                hints=[(matches("cannot process request"), NEGATIVE_TEXT), (ANYTHING, NEGATIVE)],
            )
        refused(
            context, till.set, "the till refuses an item without a name", "", item="", cents=5, hints=NAMELESS
        )
        _totals(context, total, prices, CHANGED, CHANGED)


def _sets(context: CheckContext, till: Till, item: str, cents: int, total: int, hint: str) -> None:
    response = till.set(item=item, cents=cents)
    context.expect("till/set returns the total", expected=total, actual=response.total, hints=hint)


def _totals(context: CheckContext, total: Service, prices: dict[str, int], count: str, cents: str) -> None:
    response = total()
    context.expect(
        "till/total returns the number of items", expected=len(prices), actual=response.items, hints=count
    )
    context.expect(
        "till/total returns the sum", expected=sum(prices.values()), actual=response.cents, hints=cents
    )


# -- 15.8

REASON = "out of paper"
LINE = 'The printed line is wrong. Print the name of the item, one space, and the cents, such as "milk 120".'
NOT_PRINTED = "The till printed nothing. Call print_line in the handler of till/set."
NOT_REFUSED = (
    "The printer refused the line, but the till accepted the item. If the printer refuses the "
    "line, raise rospy.ServiceException."
)
REASONLESS = (
    "The error message does not contain the printer's message. Use the text of the exception that you caught."
)
COUNTED = (
    "The line was not printed, but the till changed its stored prices. Change the stored prices only "
    "after print_line has returned."
)
NO_PRINTER = (
    "The service print_line does not exist, and the till did not refuse the call within 5 s. If the "
    "till waits for this service, use a time limit."
)
RESTARTED = (
    "The printer was started again, but the till still refuses an item. Create the proxy without "
    "persistent=True, because a closed connection of a persistent proxy is never opened again."
)
REPEATED = (
    "The till called print_line again after the printer had refused the line. Call print_line only once for "
    "each call of till/set."
)
ILLEGAL = (
    "The till printed a line for a refused item. Check for negative cents and an empty name before you print."
)
ORDER = (
    "A total is not the sum of the prices that were printed so far, because another call changed "
    "the till at the same time. "
    "Hold one lock while you print the line, store the price and calculate the total."
)


@part(
    "15.8",
    points=3,
    goal=(
        "Extend till.py: print a line for each item, and store the price only after the line was "
        "printed. Print only one line at a time."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME, "# Copy your program of exercise 15.7 into this cell, and extend the copy.\n..."),
    goals={PRINTED: 2, "Print one line at a time. Refuse an item if there is no printer.": 1},
)
def the_printed_till(context: CheckContext) -> None:
    """Call till/set while the printer works, and while it refuses; then make many calls at the same time.

    Later, call till/set without a printer, and again with a new printer.
    """
    with running_till(context, TOTAL) as till:
        total = till.service(context, TOTAL, TILL_TOTAL, [(matches("TimesUp"), BROKEN)])
        (item, cents), (other, more), (third, rest) = _items(context, 3)
        _sets(context, till, item, cents, cents, NOT_ADDED)
        context.require(
            "the till prints a line",
            holds=bool(till.printer.lines),
            expected="a line",
            actual="none",
            hints=NOT_PRINTED,
        )
        context.expect(
            "the line consists of the item and its cents",
            expected=f"{item} {cents}",
            actual=till.printer.lines[0],
            hints=LINE,
        )
        prices = {item: cents}
        _refuses_without_print(context, till, total, prices, (other, more))
        _sets(context, till, other, more, cents + more, NOT_ADDED)
        before = len(till.printer.lines)
        _sets(context, till, other, more, cents + more, TWICE)
        context.require(
            "the till prints a line",
            holds=len(till.printer.lines) == before + 1,
            expected="one line for each call, even if the price did not change",
            actual=f"{len(till.printer.lines) - before} lines",
            hints=(
                "The number of printed lines is wrong. Print exactly one line in each call of "
                "till/set, even if the item already has this price."
            ),
        )
        _prints_no_illegal_item(context, till)
        context.fulfilled(PRINTED)
        _adds_up_in_order(context, till, {**prices, other: more})
        _refuses_without_printer(context, till, third, rest)
        _prints_with_a_new_printer(context, till, third, rest)


def _refuses_without_print(
    context: CheckContext, till: Till, total: Service, prices: dict[str, int], item: tuple[str, int]
) -> None:
    """Let the printer refuse a new item, and then a new price for an existing item."""
    till.printer.fault = REASON
    for name, cents in (item, (next(iter(prices)), 1)):
        before = till.printer.calls
        refused(
            context,
            till.set,
            "if the printer refuses a line, the till refuses the item with the printer's message",
            REASON,
            item=name,
            cents=cents,
            hints=[
                (partial(_printed_again, till.printer, before), REPEATED),
                (matches("TimesUp"), BROKEN),
                (matches("cannot process request"), REASONLESS),
                (ANYTHING, NOT_REFUSED),
            ],
        )
        context.require(
            "if the printer refuses a line, the till refuses the item with the printer's message",
            holds=till.printer.calls <= before + 1,
            expected="one call of print_line",
            actual=f"{till.printer.calls - before} calls",
            hints=REPEATED,
        )
        _totals(context, total, prices, COUNTED, COUNTED)
    till.printer.fault = ""


def _printed_again(printer: Printer, before: int, error: object) -> bool:
    """Return whether a call did not end, because the till called the printer several times."""
    return "TimesUp" in str(error) and printer.calls > before + 1


def _prints_no_illegal_item(context: CheckContext, till: Till) -> None:
    before = len(till.printer.lines)
    refused(
        context, till.set, "the till refuses an item without a name", "", item="", cents=5, hints=NAMELESS
    )
    refused(context, till.set, "the till refuses negative cents", "", item="x", cents=-5, hints=NEGATIVE)
    context.expect(
        "the till prints nothing for a refused item",
        expected=[],
        actual=till.printer.lines[before:],
        hints=ILLEGAL,
    )


def _adds_up_in_order(context: CheckContext, till: Till, prices: dict[str, int]) -> None:
    """Make many calls of till/set at the same time.

    After each printed line, the total must have increased by the item's price.
    """
    before = len(till.printer.lines)
    items = _items(context, MANY)
    replies = till.set.at_once([{"item": item, "cents": cents} for item, cents in items])
    context.expect(
        "the printer never gets two lines at the same time",
        expected=0,
        actual=till.printer.jams,
        hints=(
            "The printer refused a line, because it was still printing another line. Hold a lock "
            "while you print, and do not repeat the call."
        ),
    )
    printed = [line.rpartition(" ") for line in till.printer.lines[before:]]
    sums = list(itertools.accumulate((int(cents) for _, _, cents in printed), initial=sum(prices.values())))
    wanted = {name: total for (name, _, _), total in zip(printed, sums[1:], strict=True)}
    context.expect(
        "each total is the sum of the prices on the printed lines",
        expected=[wanted.get(item) for item, _ in items],
        actual=[reply.response.total for reply in replies],
        hints=ORDER,
    )


def _refuses_without_printer(context: CheckContext, till: Till, item: str, cents: int) -> None:
    till.server.leave()
    refused(
        context,
        till.set,
        "without a printer, the till refuses an item",
        "",
        item=item,
        cents=cents,
        hints=NO_PRINTER,
    )


def _prints_with_a_new_printer(context: CheckContext, till: Till, item: str, cents: int) -> None:
    """Start the printer again, and assert that the till accepts the item that it has just refused."""
    context.serve(f"{till.space}/{PRINT}", PRINT_LINE, till.printer.answer)
    before = len(till.printer.lines)
    till.service(context, SET, TILL_SET, [(ANYTHING, RESTARTED)])(item=item, cents=cents)
    context.require(
        "the till prints a line",
        holds=len(till.printer.lines) == before + 1,
        expected="a line on the new printer",
        actual="none",
        hints=NOT_PRINTED,
    )


# -- 15.9

SUCCEEDS = "The field `success` is False, but a reset always succeeds. Set this field to True."
PAID = 'The message is wrong. Write "paid", the sum of all items and "cents", such as "paid 460 cents".'
EMPTY = 'The till has no items, so the message has to be "already empty". Set the field `success` to True.'
FREE_ITEM = (
    "The till has an item that costs 0 cents, so it is not empty. Check the number of items, not the sum."
)
KEPT = "The till still has items after a reset. Remove all items in the handler of till/reset."
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
        items = _items(context, 2)
        paid = sum(cents for _, cents in items)
        old = items[1][1]  # The first item has this price at first, and later its price in `items`.
        for item, cents in ((items[0][0], old), *items):
            till.set(item=item, cents=cents)
        _resets(context, reset, f"paid {paid} cents", [(f"paid {paid + old} cents", TWICE), (ANYTHING, PAID)])
        _totals(context, total, {}, KEPT, KEPT)
        _resets(context, reset, "already empty", EMPTY)
        till.set(item=items[0][0], cents=0)
        _resets(context, reset, "paid 0 cents", FREE_ITEM)
        context.fulfilled(EMPTIED)
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
    first, second = _items(context, 2)
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
    _totals(context, total, {}, LEFT, LEFT)
