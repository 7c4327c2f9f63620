"""12.8: nothing counts that was not printed, and the printer takes one line at a time."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service

COUNT = 8  # who set an item at the same time

A_PRINTER = """
import rospy
from course_pkg.shop import Printer
from course_pkg.srv import TillSet


class Trial:
    service = None

    def open(self, cls, to_set):
        self.printer = Printer()
        till = cls(self.printer)
        self.service = rospy.Service(to_set, TillSet, till.handle_set)

    def paper(self, lines):
        self.printer.paper = len(self.printer.lines) + lines

    def lines(self):
        return self.printer.lines

    def close(self):
        if self.service:
            self.service.shutdown("checked")


trial = Trial()
"""
JAM = (
    "Two lines were printed at the same time. rospy runs each handler on a thread of its own: hold one lock, "
    "made in __init__, while you print and count."
)
STUCK = (
    "The till never answers again: a lock was taken, an error came, and nobody gave it back. with self.turn: "
    "gives it back also then."
)
TRIES = "It tries again and again, and the caller stands there. Without paper it refuses, and at once."
ERRORS = {
    says("cannot process request.*jam|error processing request.*jam"): JAM,
    says("TimesUp"): STUCK,
    says("returned None"): "The handler came to its end without a return: return the total.",
    says("paper"): "There was paper again. Print anew each time, and keep nothing of an earlier failure.",
}


@part(
    "12.8",
    points=3,
    goal="Print, then count, one at a time; what could not be printed does not count.",
    needs=["PrintedTill"],
    deadline=30.0,
)
def a_printed_till(exam: Exam) -> None:
    """Set items one by one and many at once, take the paper away in between, and give it back."""
    name = f"/{exam.draw.word()}"
    exam.prepare(A_PRINTER)
    opened = exam.run("trial.open", Its("PrintedTill"), name, worded="PrintedTill(printer)")
    exam.hold("a PrintedTill can be made and served", not opened.error, seen=opened.error)
    try:
        to_set = exam.service(name, "course_pkg/TillSet", hints=ERRORS)
        item, total = _one(exam, to_set)
        total = _without_paper(exam, to_set, item, total)
        _many(exam, to_set, total)
    finally:
        exam.run("trial.close")


def _one(exam: Exam, to_set: Service) -> tuple[str, int]:
    item, cents = exam.draw.choice(["milk", "bread", "apples"]), exam.draw.integer(100, 900)
    exam.expect("the answer is the total", expected=cents, seen=to_set(item=item, cents=cents).total)
    exam.expect(
        "a line has the item and its cents",
        expected=[f"{item} {cents}"],
        seen=exam.run("trial.lines").value,
        hints={(): "Nothing was printed: self.printer.print(…).", says(""): 'The line is f"{item} {cents}".'},
    )
    return item, cents


def _without_paper(exam: Exam, to_set: Service, item: str, total: int) -> int:
    """Try an item that is new, and another price for one that is not."""
    exam.run("trial.paper", 0)
    lost = exam.draw.integer(1000, 9000)
    for name in ("lost", item):
        _is_refused(to_set, name, lost)
    exam.run("trial.paper", 100)
    cents = exam.draw.integer(100, 900)
    exam.expect(
        "what could not be printed does not count",
        expected=total + cents,
        seen=to_set(item="found", cents=cents).total,
        hints={
            cents: "The item was there before, and is gone now. After a refusal nothing has changed: not the "
            "old price either. Print first, and count then.",
            says(""): "A price that nobody has on paper is in the sum. Print first, and count then.",
        },
    )
    return total + cents


def _is_refused(to_set: Service, item: str, cents: int) -> None:
    to_set.refused(
        "without paper it refuses, and says why",
        saying="cannot process request.*paper",
        item=item,
        cents=cents,
        hints=[
            (says("TimesUp"), STUCK if item != "lost" else TRIES),
            (
                (lambda seen: isinstance(seen, dict)),
                "Nothing was printed, and it answered as if all were well. "
                "Catch PrinterFailed only to refuse.",
            ),
            (
                says("error processing request"),
                "The caller reads *error processing*, as of a slip in your "
                "program. Catch PrinterFailed, and raise rospy.ServiceException with its words.",
            ),
            (says("cannot process"), "The words don't say why: hand on those of PrinterFailed, str(error)."),
        ],
    )


def _many(exam: Exam, to_set: Service, total: int) -> None:
    amounts = exam.draw.integers(COUNT, 1, 900)
    requests = [{"item": f"item {number}", "cents": cents} for number, cents in enumerate(amounts)]
    replies = to_set.at_once(requests)
    wanted = total + sum(amounts)
    seen = to_set(item="found", cents=0)
    found = int(exam.run("trial.lines").value[1].split()[-1])
    exam.expect(
        "what many set at once adds up",
        expected=wanted - found,
        seen=seen.total,
        hints=[
            (
                lambda seen: seen > wanted - found,
                "An item that was set again is in the sum twice. Its new price takes the place of the old.",
            ),
            (
                says(""),
                "Some are missing in the sum: one thread put back what it had read before another one wrote. "
                "Read, print and write with the lock held all the time.",
            ),
        ],
    )
    sums = sorted(reply.response.total for reply in replies)
    steps = sorted(after - before for before, after in zip([total, *sums], sums, strict=False))
    exam.expect(
        "each answer is the total at its own turn",
        expected=sorted(amounts),
        seen=steps,
        hints="An answer holds what others had added in between, or lacks it. Add up before you let go of "
        "the lock.",
    )
    exam.expect(
        "each has its line",
        expected=sorted(f"{request['item']} {request['cents']}" for request in requests),
        seen=sorted(line for line in exam.run("trial.lines").value if line.startswith("item")),
        hints="A line is missing, or was printed twice. Print once for each request.",
    )
