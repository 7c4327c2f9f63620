"""10.4: a client that gets its answer, once, whatever happens on the way."""

from __future__ import annotations

import threading
from itertools import pairwise

from course_pkg.examiner import Exam, HangUp, Late, Refuse, Silence, part, says
from course_pkg.examiner.checks.chapter_10.selling import CHARGE
from course_pkg.examiner.faults import Crash, Fault, FaultyServer, Frozen, Stumble
from course_pkg.examiner.ledger import Hints
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.plain import Message, Plain

TRY = 0.5  # s for one try, as the exercise says
PAUSE = 0.1  # s before the second try; twice as long before each further one
DEADLINE = 6.0  # s, where it must not run out
SHORT = 1.0  # s, where it has to
SLACK = 1.5  # s: a busy machine is no mistake
AWAY = 0.5  # s until a till that ended is back: the second try finds nobody
A_LITTLE = 0.2  # s that a try has time for
MOST = 5  # tries that fail, while pauses are no longer than doubled ones

SLOW = "slow"
FAULTS = {
    "stumbling": [Fault(Stumble("list index out of range"))],
    SLOW: [Fault(Late(1.2, {}), worked=True)],
    "frozen": [Fault(Frozen())],
    "killed after it charged, and started again": [Fault(Crash(AWAY), worked=True)],
    "shut down and started again": [Fault(Crash(AWAY, farewell=True))],
}
ERRORS = {
    says("TimesUp"): (
        "It waits for ever for a till that says nothing: rospy has no limit. Use node.call(..., "
        "timeout=...), and end the whole when the deadline has passed."
    ),
    says(
        "^CallTimeout"
    ): "A try had its time, and CallTimeout ended everything. Catch it beside ServiceException.",
    says(
        "^ServiceException"
    ): "One failed try ended everything. Catch rospy.ServiceException, and try again.",
    says("unsupported operand|NoneType"): "Something is None here: look what the last try left behind.",
}

UNKNOWN = "Nobody knows whether it was paid. Return None, and raise nothing."
GIVEN_UP = {says("^CallTimeout|^ServiceException"): UNKNOWN, **ERRORS}


class Books:
    """What a till knows: each request once."""

    def __init__(self, exam: Exam) -> None:
        self.charged: dict[str, int] = {}
        self._first = exam.draw.integer(1000, 9000)
        self._lock = threading.Lock()

    def work(self, request: Message) -> dict[str, Plain]:
        """Charge, unless this request was charged already; return the receipt."""
        with self._lock:
            self.charged.setdefault(request.request_id, request.cents)
            return {"receipt": self.receipt({"request_id": request.request_id})}

    def receipt(self, request: dict[str, Plain]) -> int:
        """Return the receipt for a request that was charged; 0 for any other."""
        known = list(self.charged)
        return self._first + known.index(request["request_id"]) if request["request_id"] in known else 0


@part(
    "10.4",
    points=4,
    goal="Pay exactly once, with a limit, whatever happens to the till; take a refusal for an answer.",
    needs=["pay"],
    deadline=60.0,
)
def a_robust_client(exam: Exam) -> None:
    """Offer a till that is well, one that refuses, and some that fail and mend; at last one that is mute."""
    books, name = Books(exam), f"/{exam.draw.word()}"
    till = exam.faulty(name, CHARGE, books.work)
    _well(exam, name, till, books)
    _refused(exam, name, till)
    first, *others = FAULTS
    tries = {}
    for words in (first, *exam.draw.shuffled(others)):
        till.plan.extend(FAULTS[words])
        tries[words] = _paid(exam, name, till, books, words)
    _given_half_a_second(exam, name, till, tries[SLOW])
    _patient(exam, name, till, books)
    _given_up(exam, name, till)
    _no_more_than_is_left(exam, name, till)


def _pay(exam: Exam, name: str, cents: int, deadline: float, hints: Hints = ERRORS) -> Outcome:
    return exam.run("pay", name, cents, deadline, within=deadline + 6.0, hints=hints)


def _well(exam: Exam, name: str, till: FaultyServer, books: Books) -> None:
    cents = exam.draw.integer(100, 900)
    for number in range(2):
        outcome = _pay(exam, name, cents, DEADLINE)
        exam.hold(
            "the till is asked",
            bool(till.requests),
            expected=f"a call of {name}",
            seen="none",
            hints="Call the service whose name is in `till`.",
        )
        request = till.requests[-1]
        exam.expect("the request holds the cents", expected=cents, seen=request["cents"])
        exam.hold(
            "the request has an id",
            bool(request["request_id"]),
            expected="a request_id",
            seen="an empty one",
            hints="Make one for each payment: str(uuid.uuid4()).",
        )
        exam.hold(
            "another payment has another id",
            len(books.charged) == number + 1,
            expected="an id that was not there before",
            seen="the id of the payment before",
            hints="Two payments, one id: the till takes the second for a repeat and charges nothing. Make a "
            "new id for each call of pay(), such as str(uuid.uuid4()).",
        )
        exam.expect(
            "the receipt is returned",
            expected=books.receipt(request),
            seen=outcome.value,
            hints={
                None: "The till answered, and None was returned. Return the receipt.",
                (lambda seen: isinstance(seen, dict)): "That is the whole response. Return its receipt.",
            },
        )
        exam.hold(
            "a payment that went well is not sent again",
            len(till.requests) == number + 1 or outcome.took > TRY,
            expected="one request for each payment",
            seen=f"{len(till.requests)} for {number + 1}",
            hints="The till had answered. Return as soon as there is a receipt.",
        )


def _refused(exam: Exam, name: str, till: FaultyServer) -> None:
    before = len(till.requests)
    reason = f"no money on card {exam.draw.integer(100, 999)}"
    till.plan.extend([Fault(Refuse(reason))] * 3)
    outcome = _pay(exam, name, exam.draw.integer(100, 900), 3.0)
    exam.expect(
        "a refusal is an answer: it is not asked again",
        expected=1,
        seen=len(till.requests) - before,
        hints=(
            "The till had decided, and was asked again. Words with `cannot process request` are its "
            "decision: raise the error on, at once."
        ),
    )
    outcome.raised(
        "a refusal comes out with its reason",
        "ServiceException",
        saying=reason,
        hints={
            None: "The till refused, and nobody hears of it. Let its error come out: raise.",
            says(""): "Raise the error that came, as it came: raise.",
        },
    )
    till.plan.clear()


def _paid(exam: Exam, name: str, till: FaultyServer, books: Books, words: str) -> int:
    """Hold that a payment gets through to `words`, and is charged once; return how many requests it took."""
    before, charged, arrived = len(till.requests), len(books.charged), len(till.arrivals)
    outcome = _pay(exam, name, exam.draw.integer(100, 900), DEADLINE)
    requests = till.requests[before:]
    ids = {request["request_id"] for request in requests}
    exam.hold(
        "each try has the same id",
        len(ids) <= 1,
        expected="one request_id",
        seen=f"{len(ids)} of them",
        hints="Every try had an id of its own, and the till charges each. Make the id once, "
        "before the first try.",
    )
    exam.expect(
        "the receipt is returned in the end",
        expected=books.receipt(requests[-1]) if requests else 0,
        seen=outcome.value,
        hints={
            None: _gave_up(words, outcome.took, len(till.arrivals) - arrived),
            says(""): "Return the receipt of the try that was answered.",
        },
    )
    exam.expect("it is charged once in the end", expected=1, seen=len(books.charged) - charged)
    return len(requests)


def _given_half_a_second(exam: Exam, name: str, till: FaultyServer, tries: int) -> None:
    """Hold that a slow till was asked again, in so many `tries`, and that one that answers in time is not."""
    exam.hold(
        "the receipt is returned in the end",
        tries > 1,
        expected=f"a try that is given up after {TRY:g} s, and another",
        seen="one that waited longer",
        hints=f"A try gets {TRY:g} s, and this one had more: node.call(..., timeout=min({TRY:g}, rest)).",
    )
    before = len(till.requests)
    till.plan.append(Fault(Late(A_LITTLE, {}), worked=True))
    outcome = _pay(exam, name, exam.draw.integer(100, 900), DEADLINE)
    tries = len(till.requests) - before
    exam.hold(
        "a payment that went well is not sent again",
        tries == 1 or outcome.took > TRY,
        expected=f"one request to a till that takes {A_LITTLE:g} s",
        seen=f"{tries} within {outcome.took:.1f} s",
        hints=f"A try gets {TRY:g} s, and these had less: who asks again too soon asks a till at work.",
    )


def _gave_up(words: str, took: float, tries: int) -> str:
    begin = f"The till was {words}. "
    if took > DEADLINE / 2 and tries < 2:
        return begin + (
            "The first try took all the time there was. Give each try half a second at most, and what is "
            "left of the deadline if that is less."
        )
    return f"{begin}It was back long before the deadline, and you had given up. Go on until the deadline."


def _patient(exam: Exam, name: str, till: FaultyServer, books: Books) -> None:
    """Fail three times: the third pause shows whether pauses grow. Only what is too short is sure."""
    before = len(till.arrivals)
    till.plan.extend([Fault(HangUp())] * 3)
    _paid(exam, name, till, books, "failing three times")
    times = till.arrivals[before:]
    pauses = [later - earlier for earlier, later in pairwise(times)]
    exam.hold(
        "there is a pause before the next try",
        min(pauses) > 0.9 * PAUSE,
        expected=f"{PAUSE:g} s or more",
        seen=f"{min(pauses):.3f} s",
        hints="A till that is being started is not helped by a thousand questions a second. "
        "time.sleep(pause) after a try that failed.",
    )
    exam.hold(
        "each pause is longer than the one before",
        pauses[2] > 3.5 * PAUSE,
        expected=f"{4 * PAUSE:g} s before the fourth try",
        seen=f"{pauses[2]:.2f} s",
        hints="At least twice as long each time. Double the pause after each try that failed: pause *= 2.",
    )
    if pauses[2] < MOST * PAUSE:  # doubled, and not more: five of them end long before the deadline
        till.plan.extend([Fault(HangUp())] * MOST)
        _paid(exam, name, till, books, f"failing {MOST} times")


def _given_up(exam: Exam, name: str, till: FaultyServer) -> None:
    till.plan.extend([Fault(Silence())] * 100)
    outcome = _pay(exam, name, exam.draw.integer(100, 900), SHORT, GIVEN_UP)
    exam.expect(
        "None when the deadline has passed",
        expected=None,
        seen=outcome.value,
        hints="Nobody knows whether it was paid. Return None.",
    )
    exam.hold(
        "the deadline is kept",
        outcome.took < SHORT + SLACK,
        expected=f"an answer after {SHORT:g} s or little more",
        seen=f"an answer after {outcome.took:.1f} s",
        hints="It went on after the deadline. Look at the clock before each "
        "try, and give a try no more than what is left.",
    )
    exam.hold(
        "the time there is is used",
        outcome.took > SHORT / 3,
        expected=f"tries for {SHORT:g} s",
        seen=f"given up after {outcome.took:.1f} s",
        hints="There was time for another try.",
    )
    till.plan.clear()


def _no_more_than_is_left(exam: Exam, name: str, till: FaultyServer) -> None:
    """Have the till answer when the deadline has passed, and half a second has not.

    On a machine that is busy a limit may be noticed late, but not each time.
    """
    value: Plain = 0
    for _ in range(3):
        till.plan.append(Fault(Late(0.3, {}), worked=True))
        value = _pay(exam, name, exam.draw.integer(100, 900), 0.05, GIVEN_UP).value
        till.plan.clear()
        if value is None:
            break
    exam.expect(
        "the deadline is kept",
        expected=None,
        seen=value,
        hints="There were 0.05 s, and the till answered after 0.3 s: nobody should have waited for it any "
        "more. Give a try no more than what is left: min(0.5, rest).",
    )
