"""12.3: the payments that a till stores, and functions that run a payment and examine its result."""

from __future__ import annotations

import threading

from course_pkg.checking import ANYTHING, CheckContext, matches
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.faulty_server import FaultyServer
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Result
from course_pkg.ros.protocol.json_channel import Json

CHARGE = "course_pkg/Charge"
# DEADLINE is the time in s from the start of a payment to its deadline if the payment is expected to succeed.
DEADLINE = 6.0
ERRORS = [
    (
        matches("TimesUp"),
        (
            "pay() waits forever if the till does not respond, because a proxy has no time limit. Use "
            "`call_within()` for each call."
        ),
    ),
    (
        matches("^TimeoutError"),
        "One call took too long, and the TimeoutError ended pay(). Catch TimeoutError, and call the till "
        "again.",
    ),
    (
        matches("^ServiceException"),
        (
            "One failed call ended pay(). Catch rospy.ServiceException, and call the till again if the "
            "error is not a refusal."
        ),
    ),
]
UNKNOWN = (
    "At the deadline, pay() raised an error. If the till has sent no receipt before the deadline, return "
    "None."
)
GIVEN_UP = [(matches("^TimeoutError|^ServiceException"), UNKNOWN), *ERRORS]


class Books:
    """The payments that a till has charged, with one payment for each request id."""

    def __init__(self, context: CheckContext) -> None:
        self.charged: dict[str, int] = {}
        self._first = context.random.integer(1000, 9000)
        self._lock = threading.Lock()

    def work(self, request: Message) -> dict[str, Json]:
        """Charge the request, unless this request was charged before; return the number of the receipt."""
        with self._lock:
            self.charged.setdefault(request.request_id, request.cents)
            return {"receipt": self.receipt({"request_id": request.request_id})}

    def receipt(self, request: dict[str, Json]) -> int:
        """Return the number of the receipt for a request, or 0 if the request was not charged."""
        known = list(self.charged)
        return self._first + known.index(request["request_id"]) if request["request_id"] in known else 0


def pay(context: CheckContext, name: str, cents: int, deadline: float, hints: Hints = ERRORS) -> Result:
    """Run the student's function; stop it 6 s after its deadline.

    `deadline` is the time in s from the call to the deadline.
    """
    return context.run("pay", name, cents, deadline, within=deadline + 6.0, hints=hints)


def pays_after(
    context: CheckContext,
    name: str,
    till: FaultyServer,
    books: Books,
    words: str,
    deadline: float = DEADLINE,
) -> int:
    """Assert that a payment succeeds; return the number of requests that the till received.

    `words` describes the state of the till in the titles of assertions.
    """
    before, charged, arrived = len(till.requests), len(books.charged), len(till.arrivals)
    result = pay(context, name, context.random.integer(100, 900), deadline)
    requests = till.requests[before:]
    ids = {request["request_id"] for request in requests}
    context.require(
        "each attempt has the same id",
        holds=len(ids) <= 1,
        expected="one request_id",
        actual=f"{len(ids)} different ids",
        hints=(
            "The calls of one payment had different ids, so the till takes the money for each call. "
            "Create the id once, before the first call."
        ),
    )
    context.expect(
        "at the end, pay() returns the receipt",
        expected=books.receipt(requests[-1]) if requests else 0,
        actual=result.returned(),
        hints=[
            (None, why_given_up(words, result.took, len(till.arrivals) - arrived)),
            (
                ANYTHING,
                (
                    "pay() returned a number that the till did not send. Call only the till, and return the "
                    "field `receipt` of its response."
                ),
            ),
        ],
    )
    context.expect(
        "at the end, the till has charged the payment exactly once",
        expected=1,
        actual=len(books.charged) - charged,
        hints=(
            "The till did not charge this payment exactly once. Return only a receipt that the till has "
            "sent, and use the same id in each attempt."
        ),
    )
    return len(requests)


def why_given_up(words: str, took: float, tries: int) -> str:
    """Return a hint for a payment of `took` s without a receipt; `tries` calls arrived at the till."""
    begin = f"During this payment, the till was {words}. "
    if took > DEADLINE / 2 and tries < 2:
        return begin + (
            "The first call used the whole time until the deadline. Limit each call to half a second, or "
            "to the remaining time if less time remains."
        )
    return (
        f"{begin}The till worked again before the deadline, but pay() had already ended. Try again "
        "until the deadline."
    )
