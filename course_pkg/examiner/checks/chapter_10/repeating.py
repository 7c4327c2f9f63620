"""10.3: a till that may be asked twice."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_10.selling import CHARGE
from course_pkg.examiner.checks.chapter_10.shelf import ONE, PATIENCE, SMALL_STACKS
from course_pkg.examiner.ledger import Hints

AT_ONCE = 50
BUYERS = 10  # who send their request five times each
A_PURSE = (
    SMALL_STACKS
    + """
import rospy
from course_pkg.srv import Charge


class CheckedPurse:
    meeting = 0.02

    def __init__(self):
        self.taken, self.asked, self.torn, self.turn = [], 0, 0, threading.Condition()

    def take(self, cents):
        with self.turn:
            self.asked += 1
            mine = self.asked
            self.turn.notify_all()
            self.turn.wait_for(lambda: self.asked > mine, self.meeting)
            if self.torn:
                self.torn -= 1
                raise RuntimeError("the drawer is stuck")
            self.taken.append(cents)

    def tear(self):
        self.torn = 1


class CheckedDesk:
    def open(self, kind, name):
        small_stacks.begin()
        self.purse = CheckedPurse()
        self.till = kind(self.purse)
        self.service = rospy.Service(name, Charge, self.till.handle_charge)

    def close(self):
        small_stacks.end()
        self.service.shutdown("checked")


checked_desk = CheckedDesk()
"""
)
AGAIN = (
    "The same request came again, and was charged again. Keep the receipt under its request_id, and look "
    "there before you take money."
)
RACE = (
    "The same request came five times at the same moment, and more than one was charged: between looking and "
    "remembering there was time for another. Look, take and remember under one lock."
)
REFUSED = (
    "A request that came again was refused. The customer never got the first answer, or it would not ask: "
    "give the "
    "same answer again."
)
NOTHING = "Return a ChargeResponse, on every way out: a function without a return line gives None."
STUCK = (
    "Nobody is answered any more after a purse that failed: the lock was taken and not given back. `with "
    "self.lock:` gives it back also when something is raised."
)


@part(
    "10.3",
    points=2,
    goal="Charge each request once, however often it comes, and answer it alike each time.",
    needs=["Till"],
    deadline=60.0,
)
def charge_once(exam: Exam) -> None:
    """Purchases, repeats, a purse that fails once, a request without an id, and fifty at once."""
    name = f"/{exam.draw.word()}"
    exam.prepare(A_PURSE)
    opened = exam.run("checked_desk.open", Its("Till"), name, worded="Till(purse)")
    exam.hold("a Till is made from a purse", not opened.error, seen=opened.error)
    hints = {says("TimesUp"): STUCK, says("returned None"): NOTHING, says("cannot process request"): REFUSED}
    charge = exam.service(name, CHARGE, hints=hints, timeout=ONE)
    crowd = exam.service(name, CHARGE, hints=hints, timeout=PATIENCE)
    try:
        _in_turn(exam, charge)
        _stuck(exam, charge)
        _unnamed(exam, charge)
        _at_once(exam, crowd)
    finally:
        exam.run("checked_desk.close")


def _in_turn(exam: Exam, charge: Service) -> None:
    cents = exam.draw.integer(100, 900)
    first, second = exam.draw.word(12), exam.draw.word(12)
    receipt = charge(request_id=first, cents=cents).receipt
    _taken(
        exam, "a new request is charged", [cents], {(): "No money was taken: self.purse.take(request.cents)."}
    )
    other = charge(request_id=second, cents=cents).receipt
    _taken(
        exam,
        "another request is charged, also one of the same amount",
        [cents, cents],
        _only_one("Two customers may pay the same amount. What tells requests apart is the request_id."),
    )
    exam.hold(
        "another request gets another receipt",
        other != receipt,
        expected="two receipts",
        seen=f"{receipt} twice",
        hints="Each purchase has a receipt of its own: count them.",
    )
    for again, before in ((first, receipt), (second, other), (first, receipt)):
        repeated = charge(request_id=again, cents=cents).receipt
        _taken(exam, "a request that comes again is not charged again", [cents, cents], AGAIN)
        exam.expect(
            "a request that comes again gets the receipt that it had",
            expected=before,
            seen=repeated,
            hints={
                0: "The receipt is 0, as a field is that gets no value. Keep the receipt, and give the same "
                "one again.",
                says(
                    ""
                ): "That is another receipt. Keep the first one under the request_id, and give it again.",
            },
        )


def _only_one(words: str) -> Hints:
    """Return hints for a purse that was used once where it should have been used twice."""
    return {(lambda seen: len(seen) < 2): words}


def _stuck(exam: Exam, charge: Service) -> None:
    request_id, cents = exam.draw.word(12), exam.draw.integer(1000, 1900)
    exam.run("checked_desk.purse.tear")
    charge.refused(
        "a purse that fails is an error to the client",
        request_id=request_id,
        cents=cents,
        hints=(
            "The purse raised, and the client got a receipt. Remember a request only after the money is "
            "there."
        ),
    )
    charge(request_id=request_id, cents=cents)
    _last(
        exam,
        "a request that failed may be sent again",
        cents,
        (
            "It failed the first time, so it was never charged, and now it counts as done. Remember it "
            "after the money "
            "was taken, not before."
        ),
    )


def _unnamed(exam: Exam, charge: Service) -> None:
    charge.refused(
        "a request without an id is refused",
        saying="cannot process request: (?!service handler returned None)",
        request_id="",
        cents=exam.draw.integer(2000, 2900),
        hints={
            says("returned None"): (
                "The handler returned nothing, and rospy says so in words of its own. Refuse: raise "
                "rospy.ServiceException(...)."
            ),
            says(
                "error processing"
            ): "Another exception came out of the handler. Refuse by rospy.ServiceException.",
            says(""): "Without an id nobody can tell a repeat from a new purchase. Refuse it: raise "
            "rospy.ServiceException(...).",
        },
    )


def _at_once(exam: Exam, charge: Service) -> None:
    before = len(_purse(exam))
    buyers = [
        {"request_id": exam.draw.word(12), "cents": exam.draw.integer(3000, 9000)} for _ in range(BUYERS)
    ]
    requests = exam.draw.shuffled(buyers * (AT_ONCE // BUYERS))
    replies = charge.at_once(requests)
    exam.expect(
        f"{AT_ONCE} at once, each request five times: each is charged once",
        expected=sorted(buyer["cents"] for buyer in buyers),
        seen=sorted(_purse(exam)[before:]),
        hints=RACE,
    )
    receipts = {
        (request["request_id"], reply.response.receipt)
        for request, reply in zip(requests, replies, strict=True)
    }
    exam.expect(
        f"{AT_ONCE} at once: one receipt for each request",
        expected=BUYERS,
        seen=len({receipt for _, receipt in receipts}) if len(receipts) == BUYERS else len(receipts),
        hints="Count receipts under the lock, too.",
    )


def _taken(exam: Exam, rule: str, expected: list[int], hints: Hints) -> None:
    exam.expect(rule, expected=expected, seen=_purse(exam), hints=hints)


def _last(exam: Exam, rule: str, cents: int, hint: str) -> None:
    exam.expect(rule, expected=cents, seen=_purse(exam)[-1], hints=hint)


def _purse(exam: Exam) -> list[int]:
    return list(exam.read("checked_desk.purse.taken"))
