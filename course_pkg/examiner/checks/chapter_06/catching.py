"""The client that lives through a failure."""

from course_pkg.examiner import Exam, HangUp, Its, Refuse, part, says
from course_pkg.examiner.checks.chapter_06.boxes import GEOMETRY, volumes
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.scripted import ScriptedServer

NO_NAMES = """
class Slip:
    def __init__(self, error):
        self.error = error

    def _raise(self, *_):
        raise self.error(f"a service has a name, and this is {type(self).__name__}")

    __bool__ = __str__ = __repr__ = __len__ = __getitem__ = __hash__ = __eq__ = _raise


class no_name:
    TypeError, AttributeError, ValueError = map(Slip, (TypeError, AttributeError, ValueError))
"""  # whatever is done with one of these raises what a slip with a name of another kind does


@part(
    "06.3",
    points=2,
    goal="Return the volume, or None if the call failed; let errors of your own come out.",
    needs=["volume_or_none"],
    deadline=30.0,
)
def catch_what_can_happen(exam: Exam) -> None:
    """Try two good servers, four that fail each in its own way, and wrong arguments of two kinds."""
    good, flat = (f"/{exam.draw.word()}" for _ in range(2))
    sides = exam.draw.numbers(3, 0.5, 9.0)
    (volume,) = volumes(exam, 1)
    exam.serve(good, GEOMETRY, lambda _: {"volume": volume})
    exam.serve(flat, GEOMETRY, lambda _: {"volume": 0.0})
    for name, expected in ((good, volume), (flat, 0.0)):
        exam.expect(
            "the volume of the answer is returned",
            expected=expected,
            seen=exam.run("volume_or_none", name, *sides).value,
            near=1e-6,
            hints={
                None: "The server answered, and None was returned. An answer of 0.0 is a volume, too.",
                (lambda seen: isinstance(seen, str)): "That is a text. Return the number as it came.",
                says(""): "Return the volume that the server answered with.",
            },
        )
    for failure, name, server in _failing(exam):
        _fails(exam, failure, name, sides)
        if server:
            exam.expect(
                "a call that failed is not made again",
                expected=1,
                seen=len(server.requests),
                hints="A call that failed may have done its work. Give up after one; others may try again.",
            )
    for slip in (f"{exam.draw.word()} metres", exam.draw.number(2.0, 9.0) * 1e200):
        _comes_out(exam, exam.run("volume_or_none", good, slip, *sides[1:]), repr(slip))
    exam.prepare(NO_NAMES)
    for kind in ("TypeError", "AttributeError", "ValueError"):
        slipped = exam.run("volume_or_none", Its(f"no_name.{kind}"), *sides)
        _comes_out(exam, slipped, f"a name that is no text: {kind}")


def _comes_out(exam: Exam, wrong: Outcome, slip: str) -> None:
    exam.hold(
        "an error of your own comes out",
        bool(wrong.error),
        expected=f"an error about {slip}",
        seen=wrong.error or "no error",
        hints="Nobody hears of a wrong argument then. Catch rospy.ServiceException, and nothing wider.",
    )


def _fails(exam: Exam, failure: str, name: str, sides: list[float]) -> None:
    """Hold that a call of `name` gives None; in `within`, a student may wait up to 10 s for the service."""
    outcome = exam.run(
        "volume_or_none",
        name,
        *sides,
        within=12.0,
        hints={
            says(
                "^ServiceException"
            ): "A call that fails raises rospy.ServiceException, no rospy.ROSException. Catch that one.",
            says(
                "^ROSException.*waiting for service"
            ): "wait_for_service raises rospy.ROSException when the time is up. Catch it there.",
        },
    )
    exam.expect(
        f"None from a server that {failure}",
        expected=None,
        seen=outcome.value,
        hints="Return None itself when the call failed, so that the caller can tell it from a volume.",
    )


def _failing(exam: Exam) -> list[tuple[str, str, ScriptedServer | None]]:
    """Return what a server does, the name at which one does it, and the server where there is one."""
    name = exam.draw.word()
    refuses = exam.serve(f"/{name}_refuses", GEOMETRY, lambda _: Refuse("not today"))
    dies = exam.serve(f"/{name}_dies", GEOMETRY, lambda _: HangUp())
    exam.absent(f"/{name}_killed", stale=True)
    return [
        ("is not there", f"/{name}_nowhere", None),
        ("refuses", f"/{name}_refuses", refuses),
        ("dies during the call", f"/{name}_dies", dies),
        ("was killed", f"/{name}_killed", None),
    ]
