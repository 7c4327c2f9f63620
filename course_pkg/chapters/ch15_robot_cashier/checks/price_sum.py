"""15.7: a till that adds the prices of the items."""

from __future__ import annotations

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.till import (
    NAME,
    NAMELESS,
    NEGATIVE,
    NOT_ADDED,
    TILL_TOTAL,
    TOTAL,
    TWICE,
    random_items,
    running_till,
    sets,
    totals,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part

FREE = "An item that costs 0 cents is missing. Store and count this item like all other items."
CASE = (
    "The items milk and MILK are two different items. Do not convert the names to small or capital letters."
)
COUNT = "The field `items` is wrong. Return the number of different items."
SUM = (
    "The field `cents` of till/total is wrong. Return the same sum as the total in the last response of "
    "till/set."
)
NEGATIVE_TEXT = (
    "The error message is not complete. Write the name of the item and the cents into the message."
)
CHANGED = (
    "The till refused the call, but the stored items have changed. Check the request before you "
    "store the price."
)
BIG = (
    "The till returned a wrong sum when the sum was above 2147483647. Do not convert the numbers "
    "to another type, because an int in Python has no limit."
)
SUMMED = "Store the price of each item, and return the sum of all prices."


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
        totals(context, total, {}, COUNT, SUM)
        prices: dict[str, int] = {}
        items = random_items(context, 4)
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
            sets(context, till, item, cents, sum(prices.values()), hint)
            totals(context, total, prices, FREE if not cents else COUNT, SUM)
        for item, cents in random_items(context, context.random.integer(40, 60)):
            prices[item] = cents
            sets(context, till, item, cents, sum(prices.values()), NOT_ADDED)
        totals(context, total, prices, COUNT, SUM)
        context.fulfilled(SUMMED)
        amount = -context.random.integer(1, 900)
        new, known = context.random.word(), items[0][0]
        # The till refuses a new item, and then a new price of an item that it already has.
        for item, word in ((new, str(amount)), (new, new), (known, known)):
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
        totals(context, total, prices, CHANGED, CHANGED)
