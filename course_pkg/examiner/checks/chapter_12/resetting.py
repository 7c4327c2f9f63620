"""12.9: a till is reset for the next customer, once or twice, and never in the middle of an item."""

from __future__ import annotations

import re
import threading

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.waiting import until

SLOW = 0.3  # s for which the check's printer goes on when a reset has come in the middle of an item

A_REGISTER = """
import threading
import time

import rospy
from course_pkg.shop import Printer
from course_pkg.srv import TillSet
from std_srvs.srv import Trigger


class Slow(Printer):
    slow = False
    begun = False

    def print(self, text):
        super().print(text)
        self.begun = True
        if self.slow:
            trial.entered.wait(2.0)
            time.sleep(SLOW)


class Turn:
    # The turn of a till at which somebody sets an item whenever a reset gives it back.
    def __init__(self, till, cents):
        self.till, self.cents, self.lock, self.count = till, cents, till.turn, 0

    def acquire(self, *args, **kwargs):
        return self.lock.acquire(*args, **kwargs)

    def release(self):
        self.count += 1
        self.till.amounts = {**self.till.amounts, f"between {self.count}": self.cents}
        self.lock.release()

    def locked(self):
        return self.lock.locked()

    def __enter__(self):
        return self.acquire()

    def __exit__(self, *_):
        self.release()


class Trial:
    services = ()

    def open(self, cls, to_reset, to_set):
        self.entered = threading.Event()
        self.printer = Slow()
        self.till = cls(self.printer)
        self.services = (
            rospy.Service(to_reset, Trigger, self.reset),
            rospy.Service(to_set, TillSet, lambda request: self.till.put(request.item, request.cents)),
        )

    def reset(self, request):
        self.entered.set()
        return self.till.handle_reset(request)

    def slow(self, slow):
        self.printer.slow, self.printer.begun = slow, False
        self.entered.clear()

    def crowd(self, cents):
        self.turn = self.till.turn = Turn(self.till, cents)

    def uncrowd(self):
        self.till.turn = self.turn.lock

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
    says("cannot process request"): (
        "A reset succeeds in any case: the caller wants an empty till, and it is empty. One who did not hear "
        "the first answer asks again."
    ),
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
    exam.prepare(A_REGISTER.replace("SLOW", str(SLOW)))
    opened = exam.run("trial.open", Its("Register"), *names, worded="Register(printer)")
    exam.hold("a Register can be made and served", not opened.error, seen=opened.error, hints=ERRORS)
    try:
        reset = exam.service(names[0], "std_srvs/Trigger", hints=ERRORS)
        to_set = exam.service(names[1], "course_pkg/TillSet")
        _one_after_the_other(exam, reset, to_set)
        _in_the_middle(exam, reset, to_set)
        _in_between(exam, reset, to_set)
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
        paid in _numbers(response.message),
        expected=f"{paid}, as a word of its own",
        seen=response.message or "no message",
        hints={
            says(
                rf"\d{paid}|{paid}\w"
            ): "The number is no word of its own: put a space on either side of it.",
            says(r"\b0\b"): "It says 0: the sum was taken when the items were gone already.",
            says(""): 'The sum of the items belongs into it, such as "paid 340 cents".',
        },
    )


def _numbers(message: str) -> list[int]:
    """Return the numbers that are words of their own in a message."""
    return [int(word) for word in re.findall(r"(?<![\w.])\d+(?!\w|\.\d)", message)]


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
    exam.run("trial.slow", True)
    setting = threading.Thread(target=to_set, kwargs={"item": "slow", "cents": cents}, daemon=True)
    setting.start()
    until(lambda: exam.run("trial.begun").value, 5.0)
    response = reset()
    setting.join(3.0)
    exam.run("trial.slow", False)
    exam.hold(
        "a reset waits for an item that is on its way",
        before + cents in _numbers(response.message),
        expected=f"{before + cents} cents paid",
        seen=response.message or "no message",
        hints="An item was being set, and the reset came in between: one customer pays too little, and the "
        "next one the rest. with self.turn: waits for its turn.",
    )
    _empty(exam, "and leaves nothing behind")


def _in_between(exam: Exam, reset: Service, to_set: Service) -> None:
    """Set an item whenever the reset gives its turn back: it was paid, or is there for the next customer."""
    before, between = exam.draw.integer(100, 900), exam.draw.integer(1000, 9000)
    to_set(item="before", cents=before)
    exam.run("trial.crowd", between)
    message = reset().message
    exam.run("trial.uncrowd")
    count = exam.read("trial.turn.count")
    left = exam.run("trial.total", worded="register.total()").value
    if not any(paid + left == before + count * between for paid in _numbers(message)):
        exam.fail(
            "no item is lost in between",
            expected=f"{before + count * between} cents, paid or left",
            seen=f"{message or 'no message'}; {left} cents left",
            hint="Between the sum and the emptying somebody else had a turn, and that item is lost. Do both "
            "in one turn.",
        )
