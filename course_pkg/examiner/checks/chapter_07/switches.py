"""07.2 and 07.3: a server that refuses what its type allows, and a client that looks before it believes."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_07.words import NO_RETURN, OWN_WORDS
from course_pkg.examiner.plain import Plain

STATES = {0: "OFF", 1: "ON"}


@part(
    "07.2",
    points=2,
    goal="Answer /my_on_off with OFF for 0 and ON for 1, and refuse any other number by name.",
    needs=["handle_on_off"],
)
def on_or_off(exam: Exam) -> None:
    """Send both numbers that are allowed, in turn, and four that are not."""
    on_off = exam.service(
        "/my_on_off",
        "course_pkg/ServiceExample",
        hints={
            OWN_WORDS: "It was refused, and is allowed. Compare request.number with 0 and 1; refuse others."
        },
    )
    for number in (*exam.draw.shuffled([0, 1]), 1, 0):
        exam.expect(
            "0 is OFF and 1 is ON",
            expected=STATES[number],
            seen=on_off(number=number).state,
            hints={
                STATES[1 - number]: "That is the other way round: 0 is OFF, 1 is ON.",
                "": "The text is empty, as a field is that never gets a value.",
                says("^(on|off)$"): "The word is right. Write it in capitals.",
                says("on|off"): "The text is OFF or ON, and nothing else.",
            },
        )
    for number in (2, -1, exam.draw.integer(3, 999_999), -exam.draw.integer(3, 999_999)):
        _refused(exam, on_off, number)


def _refused(exam: Exam, on_off: Service, number: int) -> None:
    words = on_off.refused(
        "any other number is refused",
        saying="responded with an error",
        hints={
            (lambda seen: seen["state"] in ("ON", "OFF")): (
                "It was answered like 0 or 1. Only these two are allowed: compare with each by ==. (In "
                "Python every number but 0 counts as true.)"
            ),
            (lambda seen: isinstance(seen, dict)): (
                "It was answered, and a client takes any answer for an answer. Raise an exception instead."
            ),
        },
        number=number,
    )
    exam.hold(
        "the refusal is a rospy.ServiceException",
        bool(OWN_WORDS.search(words)),
        expected="service cannot process request: …, in words of your own",
        seen=words,
        hints={
            says("field state|handler returned inv"): "Do not return the refusal, raise it, as an exception.",
            says("error processing request"): (
                "Another exception came out of the handler, and reads as a fault of the server. Raise "
                "rospy.ServiceException."
            ),
            says("returned None"): (
                "The handler returned None, and rospy found the words. Raise rospy.ServiceException with "
                "words of your own."
            ),
        },
    )
    exam.hold(
        "the words name the number",
        str(number) in words.partition("process request:")[2],
        expected=f"words with {number} in them",
        seen=words,
        hints="Say which number arrived: whoever sent it may not know.",
    )


@dataclass(frozen=True)
class Case:
    """What a switch does when it is asked to move: all but `name` is what can be seen from outside."""

    name: str  # as rules call it
    there: bool  # it stood there already
    obeys: bool
    success: bool  # what it answers
    due: str
    confused: dict[str, str]  # hints, by what was returned in place of what is due


CASES = (
    Case(
        "a switch that moves",
        there=False,
        obeys=True,
        success=True,
        due="moved",
        confused={
            "was there": "It said success=True, and stands there now: it moved.",
            "failed": "It stands there now. Compare the message of its report with open and with closed.",
        },
    ),
    Case(
        "a switch that is there already",
        there=True,
        obeys=True,
        success=False,
        due="was there",
        confused={
            "moved": "It said success=False, and stands where it should: it had no need to move.",
            "failed": "success=False is an answer, no failure: it stands where it should. Ask its report.",
        },
    ),
    Case(
        "a switch that says no and stays",
        there=False,
        obeys=False,
        success=False,
        due="failed",
        confused={
            "was there": "It said success=False and stands elsewhere. Its report tells the two apart.",
            "moved": "It said success=False, and it stands elsewhere.",
        },
    ),
    Case(
        "a switch that says yes and stays",
        there=False,
        obeys=False,
        success=True,
        due="failed",
        confused={
            "moved": "It said success=True and stands elsewhere. Ask its report, behind set, and believe it.",
            "was there": "It said success=True, and stands elsewhere, before and after.",
        },
    ),
)


@dataclass
class FakeSwitch:
    """A switch that does what a case says."""

    case: Case
    stands_open: bool
    words: str

    def handle_set(self, request: Plain) -> dict[str, Plain]:
        """Move if the case says so, and answer what the case says."""
        self.stands_open = bool(request.data) if self.case.obeys else self.stands_open
        return {"success": self.case.success, "message": self.words}

    def handle_report(self, _: Plain) -> dict[str, Plain]:
        """Say where it stands, which is true."""
        return {"success": True, "message": "open" if self.stands_open else "closed"}


@part(
    "07.3",
    points=3,
    goal="Have a switch moved, look where it stands, and say whether it moved, was there, or failed.",
    needs=["move"],
    deadline=25.0,
)
def move_and_verify(exam: Exam) -> None:
    """Try four kinds of switches, each towards open and towards closed."""
    for case in CASES:
        for to_open in exam.draw.shuffled([True, False]):
            _move(exam, case, to_open)


def _move(exam: Exam, case: Case, to_open: bool) -> None:
    name = f"/{exam.draw.word()}"
    switch = FakeSwitch(case, to_open is case.there, exam.draw.word())
    setting = exam.serve(f"{name}/set", "std_srvs/SetBool", switch.handle_set)
    exam.serve(f"{name}/report", "std_srvs/Trigger", switch.handle_report)
    unavailable = (
        "A switch serves set and report, below the name of its node: f'{switch}/set'. Others need not."
    )
    outcome = exam.run("move", name, to_open, hints={says("unavailable"): unavailable}).value
    exam.expect(
        "set is called once, with where to go",
        expected=[{"data": to_open}],
        seen=setting.requests,
        hints=[
            ([], "Nobody asked the switch to go anywhere. Call its set first, and look after that."),
            ([{"data": not to_open}], "It was sent the other way: data=True opens."),
            (says(""), "Once is enough: the answer to the first call says what it did."),
        ],
    )
    exam.expect(
        f"{case.name}: {case.due}",
        expected=case.due,
        seen=outcome,
        hints=[
            (None, NO_RETURN),
            ((lambda seen: isinstance(seen, bool)), "There are three outcomes, and a bool has two values."),
            ((lambda seen: switch.words in seen), "Those words are for people, and each switch has its own."),
            *case.confused.items(),
            (says(""), "Return one of the three texts: moved, was there, failed."),
        ],
    )
