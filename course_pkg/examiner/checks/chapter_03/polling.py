"""03.1: a client that asks again and again, seldom enough and not for ever."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from course_pkg.examiner import Exam, Late, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.plain import Message, Plain
from course_pkg.examiner.scripted import Act, ScriptedServer

DETECT = "course_pkg/DetectCustomer"
SLACK = 0.7  # s: a busy machine is no mistake
NO_RETURN = "None was returned. Return the number of the customer as soon as there is one."
NO_PAUSE = "1 / rate is the pause in seconds: time.sleep(1 / rate) between one question and the next."
NO_END = (
    "It goes on asking when the time is over. Note when that will be, time.monotonic() + seconds, and ask "
    "only until then."
)


@dataclass
class Counter:
    """A detector with one customer, who comes `after` s from now; each answer takes `slow` s."""

    number: int
    after: float
    slow: float = 0.0
    asked: list[float] = field(default_factory=list)
    opened: float = field(default_factory=time.monotonic)

    def answer(self, _: Message) -> Act:
        """Say who is there now."""
        self.asked.append(time.monotonic())
        there = self.asked[-1] - self.opened >= self.after
        answer: dict[str, Plain] = {"detected": there, "number": self.number if there else 0}
        return Late(self.slow, answer) if self.slow else answer


@part(
    "03.1",
    points=2,
    goal="Ask for a customer, again and again, so often and so long as is allowed.",
    needs=["poll"],
    deadline=30.0,
)
def poll_with_a_deadline(exam: Exam) -> None:
    """Have a customer there; one who comes; nobody; and nobody with a detector that takes its time."""
    _one_who_is_there(exam)
    _one_who_comes(exam)
    _nobody(exam)
    _nobody_slowly(exam)


def _one_who_is_there(exam: Exam) -> None:
    counter = Counter(exam.draw.integer(100, 999), after=0.0)
    outcome, server = _polled(exam, counter.answer, seconds=4.0, rate=1.0)
    _asked_as_it_should(exam, server)
    exam.expect(
        "the number of the customer is returned", expected=counter.number, seen=outcome.value, hints=_NUMBER
    )
    exam.expect(
        "it stops asking when there is a customer",
        expected=1,
        seen=len(counter.asked),
        hints="Somebody was there at the first question. Keep the answer, look at it, and return.",
    )
    exam.hold(
        "it asks before it pauses",
        outcome.took < 0.9,
        expected="an answer at once from a counter where somebody is",
        seen=f"an answer after {outcome.took:.1f} s",
        hints="The customer was there, and had to wait. Ask first, and pause when the answer is no.",
    )


def _one_who_comes(exam: Exam) -> None:
    counter = Counter(exam.draw.integer(100, 999), after=0.7)
    outcome, _ = _polled(exam, counter.answer, seconds=4.0, rate=5.0)
    exam.expect(
        "a customer who comes later is found",
        expected=counter.number,
        seen=outcome.value,
        hints={
            **_NUMBER,
            None: "The first answer was no, and the time was not over. Ask again."
            if len(counter.asked) == 1 and outcome.took < 4.5
            else f"It asked {len(counter.asked)} times, and the customer came. {NO_PAUSE}",
        },
    )
    exam.hold(
        "a customer who comes does not wait longer than a pause",
        outcome.took < 0.7 + 0.2 + SLACK,
        expected="an answer about 0.2 s after the customer, at the latest",
        seen=f"an answer {outcome.took - 0.7:.1f} s after the customer",
        hints=f"The questions came too seldom, or the answer was kept back. {NO_PAUSE}",
    )


def _nobody(exam: Exam) -> None:
    counter = Counter(0, after=float("inf"))
    seconds, rate = 1.5, 8.0
    outcome, _ = _polled(exam, counter.answer, seconds=seconds, rate=rate)
    exam.expect(
        "None when nobody comes",
        expected=None,
        seen=outcome.value,
        hints={
            0: "0 is what the field holds when nobody is there. Return None.",
            says(""): "Nobody came. Return None when the time is over.",
        },
    )
    exam.hold(
        "it asks no more often than it may",
        len(counter.asked) <= seconds * rate + 2,
        expected=f"at most {seconds * rate + 1:g} questions in {seconds:g} s, at {rate:g} a second",
        seen=f"{len(counter.asked)} questions",
        hints=f"So many questions keep two programs busy, and bring nothing. {NO_PAUSE}",
    )
    exam.hold(
        "it does not give up early",
        outcome.took > seconds - 1 / rate - 0.2,
        expected=f"questions for {seconds:g} s",
        seen=f"an end after {outcome.took:.1f} s",
        hints="The time was not over yet, and a customer might have come. Ask until it is.",
    )
    exam.hold(
        "it asks about as often as it may",
        len(counter.asked) >= seconds * rate / 3,
        expected=f"up to {seconds * rate + 1:g} questions in {seconds:g} s",
        seen=f"{len(counter.asked)} questions",
        hints=f"So seldom a question makes customers wait. {NO_PAUSE}",
    )
    _ends_in_time(exam, outcome, seconds + 1 / rate)


def _nobody_slowly(exam: Exam) -> None:
    counter = Counter(0, after=float("inf"), slow=0.3)
    outcome, _ = _polled(exam, counter.answer, seconds=1.2, rate=10.0)
    _ends_in_time(
        exam,
        outcome,
        1.2 + 0.3 + 0.1,
        "Each answer took 0.3 s here, and that time counts, too. Don't count questions: look at the clock, "
        "time.monotonic(), before each.",
    )


def _ends_in_time(exam: Exam, outcome: Outcome, latest: float, hint: str = NO_END) -> None:
    outcome.value  # noqa: B018 -- that it returns is a rule
    exam.hold(
        "it ends when the time is over",
        outcome.took < latest + SLACK,
        expected=f"an end after about {latest:.1f} s",
        seen=f"an end after {outcome.took:.1f} s",
        hints=hint,
    )


def _polled(
    exam: Exam, script: Callable[[Message], Act], *, seconds: float, rate: float
) -> tuple[Outcome, ScriptedServer]:
    name = f"/{exam.draw.word()}"
    server = exam.serve(name, DETECT, script)
    hints = {
        says("^TimesUp"): f"{NO_END} And mind the pause: {NO_PAUSE}",
        says("^(TimeoutError|ROSException)"): "Nobody came, and that is no error: return None.",
        says(
            "is not an attribute of DetectCustomerRequest"
        ): "The request has the fields after and patience.",
    }
    outcome = exam.run("poll", name, seconds, rate, within=8.0, hints=hints)
    outcome.value  # noqa: B018 -- that it returns is a rule, and comes before all others
    return outcome, server


def _asked_as_it_should(exam: Exam, server: ScriptedServer) -> None:
    exam.hold(
        "the service that was named is asked",
        bool(server.requests),
        expected="a call of the service in `service`",
        seen="no call of it",
        hints="Call node.call with the name in `service` and the type DetectCustomer.",
    )
    exam.expect(
        "the questions only look: patience is 0",
        expected=0.0,
        seen=server.requests[0]["patience"],
        hints="That lets the detector wait, and is the third design. Who polls asks with patience=0.",
    )
    exam.expect(
        "the questions ask for anybody: after is 0",
        expected=0,
        seen=server.requests[0]["after"],
        hints="Only customers with a higher number count then. after=0 is anybody.",
    )


_NUMBER = {
    None: NO_RETURN,
    True: "That is whether somebody is there. Return who: the field number.",
    (lambda seen: "number" in seen): "That is the whole answer. Return its field number.",
    (lambda seen: isinstance(seen, str)): "That is a text. Return the number as it came.",
    (lambda seen: isinstance(seen, list)): "That is a list. Return the one number, as soon as there is one.",
    says(""): "Return the field number of the answer, as it came.",
}
