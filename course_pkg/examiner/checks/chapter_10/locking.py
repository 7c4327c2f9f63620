"""10.1: a handler that fifty callers may run at once."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_10.shelf import A_SHELF, CALLERS, ONE, PATIENCE, TEXT, TRIGGER

STUCK = (
    "A caller waits for ever: somebody took the lock and never gave it back. `with self.lock:` gives it back "
    "on every way out, a return and an exception too; and who holds it must not take it once more."
)
ERRORS = {
    **TEXT,
    says("TimesUp"): STUCK,
    says("cannot process request: '?b?'?sold out"): (
        "Sold out is an ordinary answer: success=False, and no error."
    ),
    says("release unlocked|un-acquired"): "A lock is given back that nobody holds. Let `with` do both.",
    says("has no attribute 'lock'"): "Make the lock in __init__, once, and keep it in self.",
}
TWICE = (
    "Two callers read the same number, and both took the last but one. Reading, deciding and writing belong "
    "under one lock, which is the same for all callers."
)


@part(
    "10.1",
    points=2,
    goal="Sell from a shelf to 50 callers at once, each thing once, and nothing that is not there.",
    needs=["Stock"],
    deadline=60.0,
)
def safe_under_fifty(exam: Exam) -> None:
    """Empty a small shelf one by one; then fifty at once at a shelf that has not enough for all."""
    name = f"/{exam.draw.word()}"
    exam.prepare(A_SHELF)
    few = exam.draw.integer(2, 4)
    take = _opened(exam, name, few, ONE)
    try:
        for left in [*range(few - 1, -1, -1), None, None]:
            _one(exam, take, left)
    finally:
        exam.run("checked_shop.close")
    count = exam.draw.integer(28, 36)
    take = _opened(exam, name, count, PATIENCE)
    try:
        _all(exam, take, count)
    finally:
        exam.run("checked_shop.close")


def _opened(exam: Exam, name: str, count: int, patience: float) -> Service:
    services = {name: "handle_take"}
    opened = exam.run(
        "checked_shop.open", Its("Stock"), count, services, worded=f"Stock(shelf) with {count} on it"
    )
    exam.hold("a Stock is made from a shelf", not opened.error, seen=opened.error)
    return exam.service(name, TRIGGER, hints=ERRORS, timeout=patience)


def _one(exam: Exam, take: Service, left: int | None) -> None:
    """Take one, after which `left` are left; None: there was nothing to take."""
    seen = take()
    exam.expect(
        "success says whether there was one",
        expected=left is not None,
        seen=seen.success,
        hints={
            True: "The shelf was empty, and one was sold. Look before you take.",
            False: "There was one, and success is False: a field that is left out is False, too.",
        },
    )
    exam.expect(
        "the message says how many are left, or sold out",
        expected="sold out" if left is None else str(left),
        seen=seen.message,
        hints={
            "": "The message is empty: a field that is left out is an empty text.",
            str((left or 0) + 1): "That is how many there were. Say how many are left after it.",
            says(""): 'What is left as text, such as "7", or the words sold out.',
        },
    )


def _all(exam: Exam, take: Service, count: int) -> None:
    replies = [reply.response for reply in take.at_once([{}] * CALLERS)]
    sold = [reply.message for reply in replies if reply.success]
    exam.expect(
        f"{CALLERS} callers at once: no more is sold than there was, and no less",
        expected=count,
        seen=len(sold),
        hints={
            (lambda seen: seen > count): TWICE,
            (lambda seen: seen < count): (
                "Somebody was turned away while there was something left. Wait for the lock; who finds it "
                "taken comes a moment later, and not in vain."
            ),
        },
    )
    exam.hold(
        f"{CALLERS} callers at once: no two get the same one",
        sorted(sold) == sorted(map(str, range(count))),
        expected="every number of what is left, once",
        seen=", ".join(sorted({message for message in sold if sold.count(message) > 1})),
        hints=TWICE,
    )
    exam.expect(
        "what is on the shelf is what was not sold",
        expected=0,
        seen=exam.read("checked_shop.shelf.count"),
        hints="Write to the shelf how many are left: self.shelf.write(...).",
    )
