"""15.8: a till that prints a line for each item."""

from __future__ import annotations

import itertools
from functools import partial

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.peers.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.till import (
    NAME,
    NOT_ADDED,
    PRINT,
    PRINT_LINE,
    SET,
    TILL_SET,
    TILL_TOTAL,
    TOTAL,
    TWICE,
    Till,
    random_items,
    refuses_illegal_items,
    running_till,
    sets,
    totals,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.peers.service_calls import Service

MANY = 8
BROKEN = (
    "After a refused call, the next call got no response. Use `with`, which also releases the "
    "lock after an exception."
)
PRINTED = "Print one line for each item, and store the price only after the line was printed."

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
        (item, cents), (other, more), (third, rest) = random_items(context, 3)
        sets(context, till, item, cents, cents, NOT_ADDED)
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
        sets(context, till, other, more, cents + more, NOT_ADDED)
        before = len(till.printer.lines)
        sets(context, till, other, more, cents + more, TWICE)
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
        totals(context, total, prices, COUNTED, COUNTED)
    till.printer.fault = ""


def _printed_again(printer: Printer, before: int, error: object) -> bool:
    """Return whether a call did not end, because the till called the printer several times."""
    return "TimesUp" in str(error) and printer.calls > before + 1


def _prints_no_illegal_item(context: CheckContext, till: Till) -> None:
    before = len(till.printer.lines)
    refuses_illegal_items(context, till)
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
    items = random_items(context, MANY)
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
