"""A driver that changes over when it is asked to."""

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.checks.chapter_08.streams import STANDING, STRAIGHT, TURNING, Stream, kind, velocity

KINDS = "it goes straight on at 1 m/s, or turns at 1 rad/s"
A_NEW_ONE = """
begins = []


def a_new_one(kind):
    begins[:] = map(float, kind().velocity())
"""  # the one that drives may have been asked to change over before


@part(
    "08.2",
    points=2,
    goal="Drive turtle1 straight on or round, and change over with each call of /toggle_forward.",
    needs=["Toggle"],
    deadline=25.0,
)
def change_over(exam: Exam) -> None:
    """Listen to it, ask it to change over once and again, and leave it alone in between."""
    toggle = exam.service(
        "/toggle_forward",
        "std_srvs/Empty",
        hints={
            says("returned None"): "Empty is an answer, too: return EmptyResponse().",
            says("UnboundLocalError|referenced before|not associated"): "The state belongs to the object: "
            "self.forward.",
        },
    )
    stream = Stream(exam)
    before = stream.now()
    _is_a_kind(exam, before)
    _stays(exam, stream, kind(before))
    toggle()
    after = stream.now()
    _is_a_kind(exam, after)
    exam.hold(
        "a call changes over",
        kind(after) != kind(before),
        expected="straight on after turning, turning after straight on",
        seen=f"{kind(after)}, as before",
        hints="The service answers, and the stream goes on as before. velocity() has to look at what the "
        "handler changed.",
    )
    _stays(exam, stream, kind(after))
    toggle()
    exam.hold(
        "the next call changes back",
        kind(stream.now()) == kind(before),
        expected=kind(before),
        seen=kind(stream.now()),
        hints="It changes over once and never back: self.forward = not self.forward.",
    )
    exam.prepare(A_NEW_ONE)
    exam.run("a_new_one", Its("Toggle"), worded="velocity() of a new Toggle()")
    begins = exam.read("begins")
    exam.hold(
        KINDS,
        begins != [0.0, 1.0],
        expected="(1.0, 0.0) from a new one",
        seen=begins,
        hints="A new one begins straight on: (1.0, 0.0).",
    )


def _is_a_kind(exam: Exam, pair: tuple[float, float]) -> None:
    wanted = {STRAIGHT: (1.0, 0.0), TURNING: (0.0, 1.0)}
    exam.hold(
        KINDS,
        pair in wanted.values(),
        expected="(1.0, 0.0) or (0.0, 1.0)",
        seen=pair,
        hints={
            (lambda seen: kind(seen) == "both at once"): "Going and turning at once is an arc. One of the "
            "two is 0.0.",
            (
                lambda seen: kind(seen) == STANDING
            ): "It is told to stand still. Return 1.0 for one of the two.",
            says(""): "The first number is the speed, the second the turn: 1.0 for one, 0.0 for the other.",
        },
    )


def _stays(exam: Exam, stream: Stream, now: str) -> None:
    kinds = {kind(velocity(arrival)) for arrival in stream.next(4)}
    exam.hold(
        "it goes on alike until it is asked",
        kinds == {now},
        expected=now,
        seen=", ".join(sorted(kinds)),
        hints="Nobody had called. velocity() is asked again and again: it reads the state, no more.",
    )
