"""12.4: the handler of detect_customer: it refuses what cannot be, and never leaves a caller standing."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service

AWAIT = "course_pkg/AwaitCustomer"
BLIND = 7.0  # s of patience at which the check's camera is silent
STANDS = 0.625  # s of patience, exact in a float32, with which a question stands until the others are there
CALLERS = 4  # who ask at the same time

A_DESK = """
import functools
import threading

import rospy
from course_pkg.errors import CameraSilent
from course_pkg.srv import AwaitCustomer


class Desk:
    def open(self, handler, service):
        self.asked = []
        self.meeting = threading.Barrier(CALLERS)
        self.together = True
        self.service = rospy.Service(service, AwaitCustomer, functools.partial(handler, self.wait))

    def wait(self, patience):
        self.asked.append(round(patience, 3))
        if patience == BLIND:
            raise CameraSilent("the camera has said nothing for 1 s, so nobody can tell")
        if patience == STANDS:
            try:
                self.meeting.wait(2.0)
            except threading.BrokenBarrierError:
                self.together = False
        return patience > 1

    def close(self):
        self.service.shutdown("checked")


desk = Desk()
"""
NO = (
    "The answer was {found: False}, which says that nobody came. A refusal is raise "
    "rospy.ServiceException(words)."
)
ERRORS = {
    says("returned None"): "The handler came to its end without a return: return what wait(...) says.",
    says("float.*not callable|takes .* positional|unexpected keyword"): (
        "wait takes one number: wait(request.patience)."
    ),
    says(
        "TimesUp"
    ): "The call has not come back: wait(...) is bounded, so what else does the handler wait for?",
    says("cannot process request"): (
        "It refused what can be answered: a patience from 0 to 60 s, and both 0 and 60 are among them."
    ),
}


@part(
    "12.4",
    points=2,
    goal="Answer detect_customer, and refuse in words what cannot be answered.",
    needs=["handle_detect"],
    deadline=30.0,
)
def answers_and_refusals(exam: Exam) -> None:
    """Serve the handler with a wait of the check's own; ask for what can be and what cannot, and at once."""
    name = f"/{exam.draw.word()}"
    numbers = {"BLIND": BLIND, "STANDS": STANDS, "CALLERS": CALLERS}
    code = A_DESK
    for word, number in numbers.items():
        code = code.replace(word, str(number))
    exam.prepare(code)
    opened = exam.run("desk.open", Its("handle_detect"), name, worded="rospy.Service(...)")
    exam.hold("the handler can be served", not opened.error, seen=opened.error)
    try:
        detect = exam.service(name, AWAIT, hints=ERRORS)
        _answers(exam, detect)
        _refuses(exam, detect)
        _no_camera(detect)
        _side_by_side(exam, detect)
    finally:
        exam.run("desk.close")


def _answers(exam: Exam, detect: Service) -> None:
    for patience in (0.0, round(exam.draw.number(2, 6, digits=1) + 0.05, 2), 60.0):
        response = detect(patience=patience)
        exam.expect(
            "found is what the waiting brought",
            expected=patience > 1,
            seen=response.found,
            hints="wait(patience) said something else. Return what it returns.",
        )
        exam.expect(
            "the caller's patience is handed on",
            expected=round(patience, 2),
            seen=exam.read("desk.asked")[-1],
            near=1e-3,
            hints="wait was called with another number: wait(request.patience).",
        )


def _refuses(exam: Exam, detect: Service) -> None:
    before = len(exam.read("desk.asked"))
    negative = -exam.draw.number(0.1, 5.0)
    for words, patience, hint in (
        ("negative", negative, "A patience below 0 was taken. From 0 to 60: look before you wait."),
        (
            "above 60",
            60.0 + exam.draw.number(0.5, 90.0),
            "More than 60 s were taken: that blocks a thread for too long.",
        ),
        (
            "infinite",
            float("inf"),
            "A patience that is infinite was taken, and the caller stands there for ever.",
        ),
        (
            "nan",
            float("nan"),
            "nan was taken. Each comparison with it is False: ask not 0 <= patience <= 60.",
        ),
    ):
        detect.refused(
            f"a patience that is {words} is refused, and the words name it",
            saying="cannot process request.*patience",
            patience=patience,
            hints=[
                ((lambda seen: isinstance(seen, dict) and before == len(exam.read("desk.asked"))), NO),
                ((lambda seen: isinstance(seen, dict)), hint),
                (
                    says("is not a bool|invalid value|wrong number of values|is not an attribute"),
                    "What is returned is an answer, and that is True or False. A refusal is raised: "
                    "raise rospy.ServiceException(words).",
                ),
                (
                    says("error processing request"),
                    "An error of another type is a stumble: *error processing*. "
                    "Raise rospy.ServiceException, which says *cannot process*.",
                ),
                (says("cannot process"), "The words don't say what was wrong: name the field, patience."),
            ],
        )
    exam.expect(
        "nobody waits for what is refused",
        expected=before,
        seen=len(exam.read("desk.asked")),
        hints="It waited first, and refused then. Look at the request before anything else.",
    )


def _no_camera(detect: Service) -> None:
    detect.refused(
        "with a silent camera the question is refused, and the words say so",
        saying="cannot process request.*camera",
        patience=BLIND,
        hints=[
            (
                (lambda seen: isinstance(seen, dict)),
                "No answer is not an answer of no: nobody can tell. "
                "Refuse, and say that the camera is silent.",
            ),
            (
                says("error processing request"),
                "The caller reads *error processing*, as of a slip in your "
                "program. Catch CameraSilent, and raise rospy.ServiceException with its words.",
            ),
            (says("cannot process"), "The words don't say why: hand on those of CameraSilent, str(error)."),
        ],
    )


def _side_by_side(exam: Exam, detect: Service) -> None:
    detect.at_once([{"patience": STANDS}] * CALLERS)
    exam.hold(
        "several callers wait side by side",
        exam.read("desk.together") is True,
        expected=f"{CALLERS} callers in wait(...) at the same time",
        seen="one who waited there alone",
        hints="One caller had to wait for another. Hold no lock while you wait.",
    )
