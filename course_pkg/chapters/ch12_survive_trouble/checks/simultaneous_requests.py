"""12.2: 50 requests that arrive at the student's till at the same time."""

from __future__ import annotations

from course_pkg.chapters.ch12_survive_trouble.checks.till_in_kernel import CheckedPurse
from course_pkg.checking import CheckContext
from course_pkg.checking.peers.service_calls import Service

AT_ONCE = 50
BUYERS = 10  # This many clients send their request five times each.
RACE = (
    "Five calls with the same request came at the same time, and the till charged this request more than "
    "once. Hold one lock while you check for a receipt, take the money and store the receipt."
)
SAME_NUMBER = "Two requests got the same receipt number. Hold the lock while you count the receipts."


def charges_each_once(context: CheckContext, purse: CheckedPurse, charge: Service) -> None:
    """Send each of ten requests five times, all at the same time; the till must charge each request once."""
    before = len(purse.took)
    buyers = [
        {"request_id": context.random.word(12), "cents": context.random.integer(3000, 9000)}
        for _ in range(BUYERS)
    ]
    requests = context.random.shuffled(buyers * (AT_ONCE // BUYERS))
    purse.await_crowd()
    replies = charge.at_once(requests)
    context.expect(
        f"{AT_ONCE} calls at the same time, each request five times: the till charges each request once",
        expected=sorted(buyer["cents"] for buyer in buyers),
        actual=sorted(purse.took[before:]),
        hints=RACE,
    )
    receipts = {
        (request["request_id"], reply.response.receipt)
        for request, reply in zip(requests, replies, strict=True)
    }
    context.expect(
        f"{AT_ONCE} calls at the same time: one receipt for each request",
        expected=BUYERS,
        actual=len({receipt for _, receipt in receipts}) if len(receipts) == BUYERS else len(receipts),
        hints=[(lambda _: len(receipts) == BUYERS, SAME_NUMBER)],
    )


def gives_different_receipts(context: CheckContext, purse: CheckedPurse, charge: Service) -> None:
    """Send many requests; if the receipt numbers are random, two of them are then probably equal."""
    purse.meeting = 0.0
    requests = [
        {"request_id": context.random.word(12), "cents": context.random.integer(100, 900)}
        for _ in range(AT_ONCE)
    ]
    receipts = [reply.response.receipt for reply in charge.at_once(requests)]
    context.require(
        "another request gets a different receipt",
        holds=len(set(receipts)) == len(receipts),
        expected=f"{AT_ONCE} receipts for {AT_ONCE} requests",
        actual=f"{len(set(receipts))} different receipts",
        hints=SAME_NUMBER,
    )
