"""12.7: a till that adds up, and refuses what cannot be."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service

A_TILL = """
import rospy
from course_pkg.srv import TillSet, TillTotal


class Trial:
    services = ()

    def open(self, cls, to_set, to_total):
        till = cls()
        self.services = (
            rospy.Service(to_set, TillSet, till.handle_set),
            rospy.Service(to_total, TillTotal, till.handle_total),
        )

    def close(self):
        for service in self.services:
            service.shutdown("checked")
        self.services = ()


trial = Trial()
"""
NO_RETURN = "The handler came to its end without a return, and a service has to answer: return the total."
ERRORS = {
    says("returned None"): NO_RETURN,
    says(
        "error processing request: '(milk|bread|apples)'"
    ): "An item that is set for the first time is in no dict yet. amounts[item] = cents puts it there.",
    says("wrong number of values|Invalid number of arguments"): (
        "TillTotal has two fields, cents and items: return both, in this order. TillSet has one, the total."
    ),
    says("cannot process request"): (
        "It refused what is good: an item that costs nothing, or one that is set again, perhaps with "
        "another price."
    ),
    says("has no attribute"): "What the handlers use has to be there from __init__ on.",
}


@part(
    "12.7",
    points=2,
    goal="Add up what items cost; a price that is set again takes the place of the old one.",
    needs=["Till"],
    deadline=30.0,
)
def a_till(exam: Exam) -> None:
    """Set items, set one of them again, ask for the total, and try what has to be refused."""
    names = [f"/{exam.draw.word()}" for _ in range(2)]
    exam.prepare(A_TILL)
    opened = exam.run("trial.open", Its("Till"), *names, worded="Till()")
    exam.hold("a Till can be made and served", not opened.error, seen=opened.error, hints=ERRORS)
    try:
        to_set = exam.service(names[0], "course_pkg/TillSet", hints=ERRORS)
        to_total = exam.service(names[1], "course_pkg/TillTotal", hints=ERRORS)
        _adds_up(exam, to_set, to_total)
        _refuses(exam, to_set, to_total)
        exam.run("trial.close")
        exam.run("trial.open", Its("Till"), *names, worded="Till()")
        shared = "Another Till() knows this one's items: what stands in the class is shared by all of them. "
        shared += "Begin with an empty dict in __init__: self.amounts = {}."
        _totals(exam, "an empty till has a total of 0", to_total, 0, 0, shared)
    finally:
        exam.run("trial.close")


def _adds_up(exam: Exam, to_set: Service, to_total: Service) -> None:
    _totals(exam, "an empty till has a total of 0", to_total, 0, 0, "Nothing was set yet: 0 cents, 0 items.")
    milk, bread, free = exam.draw.shuffled(["milk", "bread", "apples"])
    first, second, third = exam.draw.integers(3, 100, 900)
    _set(exam, "the answer is the total", to_set, milk, first, first, {})
    _set(
        exam,
        "the answer is the total",
        to_set,
        bread,
        second,
        first + second,
        {
            second: "That is the price of this item. The answer is the sum of all of them.",
        },
    )
    again = {
        first + second + first: "The item was set twice with one price, and counts twice. Keep a price for "
        "each item, in a dict: a caller that lost the answer asks again, and must do no harm.",
    }
    _set(exam, "an item that is set again counts once", to_set, milk, first, first + second, again)
    _set(
        exam,
        "a new price takes the place of the old one",
        to_set,
        milk,
        third,
        second + third,
        {
            first
            + second
            + third: "Both prices of one item are in the sum. The new one takes the place of the old.",
            first + second: "The old price stayed. Setting an item again changes its price.",
        },
    )
    _set(exam, "an item may be free", to_set, free, 0, second + third, {})
    wrong = "TillTotal answers with the sum in cents and the number of items, a free one included."
    _totals(exam, "cents and items are told", to_total, second + third, 3, wrong)
    huge = 2**40
    _set(exam, "an item that has 0 cents now costs nothing", to_set, bread, 0, third, {})
    _set(exam, "amounts beyond 32 bits add up", to_set, bread, huge, huge + third, {})
    _set(exam, "an item that has 0 cents now costs nothing", to_set, bread, 0, third, {})


def _set(
    exam: Exam, rule: str, service: Service, item: str, cents: int, total: int, hints: dict[int, str]
) -> None:
    response = service(item=item, cents=cents)
    every = [*hints.items(), (says(""), "The total is the sum of the newest price of each item.")]
    exam.expect(rule, expected=total, seen=response.total, hints=every)


def _totals(exam: Exam, rule: str, service: Service, cents: int, items: int, hint: str) -> None:
    response = service()
    exam.expect(
        rule,
        expected=[cents, items],
        seen=[response.cents, response.items],
        hints=[
            ([items, cents], "The two are the wrong way round: cents first."),
            (says(""), hint),
        ],
    )


def _refuses(exam: Exam, to_set: Service, to_total: Service) -> None:
    before = to_total()
    negative = -exam.draw.integer(1, 900)
    item = exam.draw.choice(["milk", "bread", "apples"])
    changed = "A request that is refused changes nothing: look at it first, and note the price only then."
    to_set.refused(
        "a negative amount is refused, and the words name the item and the amount",
        saying=f"cannot process request.*{item}.*{negative}|cannot process request.*{negative}.*{item}",
        item=item,
        cents=negative,
        hints=[
            (
                (lambda seen: seen["total"] != before.cents),
                "A negative amount was taken. Refuse it: raise rospy.ServiceException(words).",
            ),
            (
                (lambda seen: isinstance(seen, dict)),
                "It was left out, and the caller thinks that all is well. "
                "Refuse it: raise rospy.ServiceException(words).",
            ),
            (
                says("error processing request"),
                "An error of another type is a stumble, *error processing*. "
                "Raise rospy.ServiceException, which says *cannot process*.",
            ),
            (
                says("cannot process"),
                "Whoever reads these words at the counter has to know what is wrong "
                "with what: put the item and the amount into them.",
            ),
        ],
    )
    to_set.refused(
        "an item without a name is refused",
        saying="cannot process request",
        item="",
        cents=exam.draw.integer(1, 900),
        hints=[
            (
                (lambda seen: isinstance(seen, dict)),
                'An empty item was taken: a field that the caller forgot is "". Refuse it.',
            ),
        ],
    )
    _totals(exam, "a refusal changes nothing", to_total, before.cents, before.items, changed)
