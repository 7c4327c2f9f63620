"""12.9: a till is reset for the next customer, once or twice, and never in the middle of an item."""

from __future__ import annotations

import threading

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service

SLOW = 0.5  # s that the check's printer takes for an item in the middle of which the till is reset

A_REGISTER = """
import time

import rospy
from course_pkg.shop import Printer
from course_pkg.srv import TillSet
from std_srvs.srv import Trigger


class Slow(Printer):
    pause = 0.0
    begun = False

    def print(self, text):
        super().print(text)
        self.begun = True
        time.sleep(self.pause)


class Trial:
    services = ()

    def open(self, cls, to_reset, to_set):
        self.printer = Slow()
        self.till = cls(self.printer)
        self.services = (
            rospy.Service(to_reset, Trigger, self.till.handle_reset),
            rospy.Service(to_set, TillSet, lambda request: self.till.put(request.item, request.cents)),
        )

    def slow(self, pause):
        self.printer.pause, self.printer.begun = pause, False

    def begun(self):
        return self.printer.begun

    def total(self):
        return self.till.total()

    def close(self):
        for service in self.services:
            service.shutdown("checked")


trial = Trial()
"""
ERRORS = {
    says("TimesUp"): (
        "It waits for itself: total() takes the turn, and you hold it already. A Lock is given once: "
        "with it in your hands add up yourself: sum(self.amounts.values())."
    ),
    says("returned None"): "The handler came to its end without a return: success and a message.",
    says("wrong number of values|Invalid number of arguments|is not a bool|must be of type"): (
        "Trigger answers with success, a bool, and message, a text: return True, words."
    ),
    says("has no attribute"): "The names are self.turn, self.amounts and self.printer, as OpenTill has them.",
}


@part(
    "12.9",
    points=2,
    goal="Reset the till for the next customer; twice does no harm, and no item is lost in between.",
    needs=["Register"],
    deadline=30.0,
)
def a_register(exam: Exam) -> None:
    """Reset after some items, again, and while an item is on its way."""
    names = [f"/{exam.draw.word()}" for _ in range(2)]
    exam.prepare(A_REGISTER)
    opened = exam.run("trial.open", Its("Register"), *names, worded="Register(printer)")
    exam.hold("a Register can be made and served", not opened.error, seen=opened.error, hints=ERRORS)
    try:
        reset = exam.service(names[0], "std_srvs/Trigger", hints=ERRORS)
        to_set = exam.service(names[1], "course_pkg/TillSet")
        _one_after_the_other(exam, reset, to_set)
        _in_the_middle(exam, reset, to_set)
    finally:
        exam.run("trial.close")


def _one_after_the_other(exam: Exam, reset: Service, to_set: Service) -> None:
    for _ in range(2):
        amounts = exam.draw.integers(3, 100, 900)
        for number, cents in enumerate(amounts):
            to_set(item=f"item {number}", cents=cents)
        _paid(exam, reset, sum(amounts))
        _empty(exam, "the next customer begins with nothing")
        _again(exam, reset)


def _paid(exam: Exam, reset: Service, paid: int) -> None:
    response = reset()
    exam.expect(
        "a reset succeeds", expected=True, seen=response.success, hints="success is False: set it, too."
    )
    exam.hold(
        "its message says how many cents were paid",
        str(paid) in response.message.split(),
        expected=f"{paid}, as a word of its own",
        seen=response.message or "no message",
        hints={
            says(r"\b0\b"): "It says 0: the sum was taken when the items were gone already.",
            says(""): 'The sum of the items belongs into it, such as "paid 340 cents".',
        },
    )


def _empty(exam: Exam, rule: str) -> None:
    outcome = exam.run(
        "trial.total",
        within=2.0,
        worded="register.total()",
        hints={
            says(
                "TimesUp"
            ): "The turn was taken and never given back: with self.turn: gives it back in any case.",
        },
    )
    exam.expect(
        rule, expected=0, seen=outcome.value, hints="There is still something in it. Empty self.amounts."
    )


def _again(exam: Exam, reset: Service) -> None:
    response = reset()
    exam.expect(
        "a second reset succeeds as well",
        expected=True,
        seen=response.success,
        hints="The caller wants an empty till, and it is empty. One who did not hear the first answer asks "
        "again.",
    )
    exam.hold(
        "and says that it was empty already",
        "already" in response.message.lower(),
        expected="a message with the word already",
        seen=response.message or "no message",
        hints="Who reads the message has to see that nothing was paid this time: say already.",
    )


def _in_the_middle(exam: Exam, reset: Service, to_set: Service) -> None:
    """Reset while an item is being printed: it counts for the customer who pays, and not for the next."""
    cents = exam.draw.integer(100, 900)
    before = exam.draw.integer(100, 900)
    to_set(item="before", cents=before)
    exam.run("trial.slow", SLOW)
    setting = threading.Thread(target=to_set, kwargs={"item": "slow", "cents": cents}, daemon=True)
    setting.start()
    for _ in range(200):
        if exam.run("trial.begun").value:
            break
    response = reset()
    setting.join(3.0)
    exam.run("trial.slow", 0.0)
    exam.hold(
        "a reset waits for an item that is on its way",
        str(before + cents) in response.message.split(),
        expected=f"{before + cents} cents paid",
        seen=response.message or "no message",
        hints="An item was being set, and the reset came in between: one customer pays too little, and the "
        "next one the rest. with self.turn: waits for its turn.",
    )
    _empty(exam, "and leaves nothing behind")
