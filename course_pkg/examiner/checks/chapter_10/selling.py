"""10.2: a server that waits for another one, and lets its own callers in meanwhile."""

from __future__ import annotations

import threading

from course_pkg.errors import GraphError
from course_pkg.examiner import Exam, Its, Refuse, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_10.shelf import A_SHELF, CALLERS, ONE, PATIENCE, TEXT, TRIGGER
from course_pkg.examiner.plain import Message
from course_pkg.examiner.scripted import Act, HangUp
from course_pkg.graph.calls import BoundedProxy

CHARGE = "course_pkg/Charge"
ASKS_BACK = 2.0  # s that the till waits for an answer before it goes on without one
LOCKED = (
    "The till asked how many are left while it was charging, and got no answer: the lock is held across the "
    "call, and /left needs it. Take one from the shelf under the lock, let go of it, and only then call."
)
STUCK = "A caller waits for ever: a lock that is taken is given back on every way out. `with` does that."
ERRORS = {**TEXT, says("TimesUp"): STUCK}
TORN = (
    "Two changed the shelf at the same time, and one of the changes is lost. Reading, deciding and writing "
    "belong under one lock, also where something is put back."
)
SOLD_OUT = "Sold out is an ordinary answer: success=False, and no error."
NOT_CAUGHT = (
    "The till failed, and its error came out of the handler. Catch rospy.ServiceException (and CallTimeout), "
    "put the thing back, and answer success=False."
)


class Till:
    """Charges and gives receipts; while it does, it asks the shop how many are left."""

    def __init__(self, exam: Exam, left: str) -> None:
        self.ways: list[Act | None] = []  # what to do instead of charging, for the next calls
        self.charged: list[int] = []  # cents
        self.ids: list[str] = []
        self.answers: list[str] = []  # to the question how many are left; "" for none
        self._first = exam.draw.integer(1000, 9000)
        self._left, self._kind = left, exam.service_class(TRIGGER)
        self._lock = threading.Lock()

    def __call__(self, request: Message) -> Act:
        """Charge, as a script of a server does."""
        with self._lock:
            asks = not self.answers
            if asks:
                self.answers.append("")
            way = self.ways.pop(0) if self.ways else None
            self.ids.append(request.request_id)
            if way is None:
                self.charged.append(request.cents)
            receipt = self._first + len(self.charged)
        if asks:
            self.answers[0] = self._asked_back()
        return {"receipt": receipt} if way is None else way

    def _asked_back(self) -> str:
        try:
            return str(BoundedProxy(self._left, self._kind, timeout=ASKS_BACK).call().message)
        except (GraphError, OSError) as error:
            return f"{type(error).__name__}"


@part(
    "10.2",
    points=3,
    goal="Sell a thing for money: reserve it under the lock, have it paid without, put it back if that "
    "fails.",
    needs=["Shop"],
    deadline=60.0,
)
def no_lock_across_a_call(exam: Exam) -> None:
    """Sell one, with a till that asks back; then fail to; then fifty at once, a few of whom cannot pay."""
    buy, left, charge = (f"/{exam.draw.word()}" for _ in range(3))
    till = Till(exam, left)
    exam.prepare(A_SHELF)
    exam.serve(charge, CHARGE, till)
    cents = exam.draw.integer(100, 900)
    count = exam.draw.integer(28, 36)
    services = {buy: "handle_buy", left: "handle_left"}
    worded = f"Shop(shelf, {cents}, the till) with {count} on the shelf"
    opened = exam.run("checked_shop.open", Its("Shop"), count, services, cents, charge, worded=worded)
    exam.hold(
        "a Shop is made from a shelf, a price and the name of a till", not opened.error, seen=opened.error
    )
    try:
        failed = {says("sold out"): SOLD_OUT, says("process request"): NOT_CAUGHT, **ERRORS}
        buying = exam.service(buy, TRIGGER, hints=failed, timeout=PATIENCE)
        looking = exam.service(left, TRIGGER, hints=ERRORS, timeout=ONE)
        _sold(exam, buying, till, cents, count)
        _not_sold(exam, buying, looking, till, count - 1)
        _fifty(exam, buying, looking, till, count - 1)
    finally:
        exam.run("checked_shop.close")


def _sold(exam: Exam, buying: Service, till: Till, cents: int, count: int) -> None:
    response = buying()
    exam.expect(
        "the till is asked to charge the price, once",
        expected=[cents],
        seen=till.charged,
        hints={
            (): "The till was never asked. Call it: node.call(self.till, Charge, ...).",
            says(""): "Charge the price once: cents=self.cents.",
        },
    )
    exam.hold(
        "the charge has an id of its own",
        bool(till.ids[0]),
        expected="a request_id",
        seen="an empty one",
        hints="Make one for each purchase: str(uuid.uuid4()).",
    )
    exam.hold(
        "whoever asks meanwhile is answered",
        till.answers[0] not in ("CallTimeout",),
        expected="an answer of /left while the till is at work",
        seen="none within 2 s",
        hints=LOCKED,
    )
    exam.expect(
        "what is being paid for is not for sale any more",
        expected=str(count - 1),
        seen=till.answers[0],
        hints={
            str(
                count
            ): "While the till is at work the thing is still on the shelf, and the next customer buys it, "
            "too. "
            "Take it from the shelf first, and put it back if the till fails.",
            says(""): "The message of /left is how many are on the shelf, as text.",
        },
    )
    exam.expect(
        "who has paid gets the receipt",
        expected=[True, str(till._first + 1)],
        seen=[response.success, response.message],
        hints={
            says("False"): "It was paid, and success is False: set it.",
            says(""): "The message is the number of the till's receipt, as text.",
        },
    )


def _not_sold(exam: Exam, buying: Service, looking: Service, till: Till, count: int) -> None:
    ways: list[Act | None] = [Refuse("no money on this card"), HangUp()]
    for way in exam.draw.shuffled(ways):
        till.ways, before = [way], len(till.ids)
        response = buying()
        asked = len(till.ids) - before
        exam.expect(
            "no sale where the till fails",
            expected=False,
            seen=response.success,
            hints="The till did not charge, and the thing was handed out. Look how the call ended."
            if asked == 1
            else "The till failed, and was asked again. Ask it once: the customer decides what comes next.",
        )
        exam.hold(
            "no sale where the till fails",
            bool(response.message),
            expected="a message that says why",
            seen="an empty one",
            hints="Say why: the error's own words, str(error), are a good message.",
        )
        exam.expect(
            "what was not paid is on the shelf again",
            expected=str(count),
            seen=looking().message,
            hints={
                str(count - 1): "The till failed, and the thing is gone. Put it back, under the lock.",
                str(count + 1): "One too many was put back. Only who has taken one puts one back.",
            },
        )


def _fifty(exam: Exam, buying: Service, looking: Service, till: Till, count: int) -> None:
    till.charged.clear()
    till.ways = [Refuse("no money on this card")] * 5
    replies = [reply.response for reply in buying.at_once([{}] * CALLERS)]
    sold = sum(reply.success for reply in replies)
    unpaid = 5 - len(till.ways)
    exam.expect(
        f"{CALLERS} at once: who is charged gets something",
        expected=sold,
        seen=len(till.charged),
        hints=(
            "More were charged than got something. Look at the shelf first, and charge only who has got one."
        ),
    )
    exam.hold(
        f"{CALLERS} at once: each purchase has an id of its own",
        len(set(till.ids)) == len(till.ids),
        expected="as many ids as purchases",
        seen="the same id twice",
        hints="Make the id in the handler, for each purchase anew.",
    )
    exam.hold(
        f"{CALLERS} at once: no more is sold than there is",
        sold <= count,
        expected=f"at most {count} sales",
        seen=sold,
        hints=TORN,
    )
    others = [reply.message for reply in replies if not reply.success and reply.message != "sold out"]
    exam.hold(
        f"{CALLERS} at once: no more is sold than there is",
        len(others) <= unpaid,
        expected="sold out, for whoever finds the shelf empty",
        seen=max(others, key=others.count, default=""),
        hints="From an empty shelf the answer is success=False and the words sold out.",
    )
    exam.expect(
        f"{CALLERS} at once: nothing is sold twice, nothing is lost",
        expected=str(count - sold),
        seen=looking().message,
        hints=TORN,
    )
