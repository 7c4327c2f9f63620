"""The student's till with a printer of the check, and assertions that several checks of the till use."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from course_pkg.chapters.ch15_robot_cashier.checks.peers.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, student_node
from course_pkg.checking import CheckContext, matches
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
ANSWER = 5.0  # A call may take up to this time in s.

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
    """Start the student's till, and a printer that the check provides."""
    with student_node(context, NAME, Interface(services=[SET, *names]), calls=[PRINT]) as space:
        printer = Printer()
        server = context.serve(f"{space}/{PRINT}", PRINT_LINE, printer.answer)
        kind = context.service(f"{space}/{SET}", TILL_SET, timeout=ANSWER, hints=SET_HINTS)
        yield Till(space, printer, server, kind)


def random_items(context: CheckContext, count: int) -> list[tuple[str, int]]:
    """Return items with different names, some of them with a space or a digit; their prices are in cents."""
    cents = context.random.integers(count, 50, 900)
    forms = itertools.cycle(("{}", "green {}", "7{}", "{}-2"))
    return [(form.format(context.random.word()), amount) for amount, form in zip(cents, forms, strict=False)]


NOT_ADDED = "The total is wrong. Return the sum of the cents of all items, including the item of this call."
TWICE = (
    "The total contains the old price and the new price of an item. If a client sets the same item "
    "again, replace the old price."
)
NEGATIVE = "The till accepted negative cents. Raise rospy.ServiceException in this case."
NAMELESS = "The till accepted an item with an empty name. Raise rospy.ServiceException in this case."


def sets(context: CheckContext, till: Till, item: str, cents: int, total: int, hint: str) -> None:
    """Set the price of an item, and assert that the response contains `total`, the sum of all prices."""
    response = till.set(item=item, cents=cents)
    context.expect("till/set returns the total", expected=total, actual=response.total, hints=hint)


def refuses_illegal_items(context: CheckContext, till: Till) -> None:
    """Assert that the till refuses an empty name and negative cents."""
    refused(
        context, till.set, "the till refuses an item without a name", "", item="", cents=5, hints=NAMELESS
    )
    refused(context, till.set, "the till refuses negative cents", "", item="x", cents=-5, hints=NEGATIVE)


def totals(context: CheckContext, total: Service, prices: dict[str, int], count: str, cents: str) -> None:
    """Assert that till/total returns the number of items and the sum of `prices`.

    `count` is the hint for a wrong number of items, and `cents` is the hint for a wrong sum.
    """
    response = total()
    context.expect(
        "till/total returns the number of items", expected=len(prices), actual=response.items, hints=count
    )
    context.expect(
        "till/total returns the sum", expected=sum(prices.values()), actual=response.cents, hints=cents
    )
