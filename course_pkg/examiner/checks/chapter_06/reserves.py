"""The client that goes on to the next server."""

from course_pkg.examiner import Exam, Late, Refuse, Silence, part, says
from course_pkg.examiner.checks.chapter_06.boxes import GEOMETRY, NO_RETURN, stops, volumes
from course_pkg.examiner.ledger import Hints
from course_pkg.examiner.outcome import Outcome


@part(
    "06.4",
    points=3,
    goal="Return the volume from the first service that answers within a second, or None.",
    needs=["first_answer"],
    deadline=30.0,
)
def ask_the_next_one(exam: Exam) -> None:
    """Offer the preferred one first; then with all kinds of failure before it; then with nothing else."""
    word = exam.draw.word()
    first, second, late = volumes(exam, 3)
    exam.serve(f"/{word}_first", GEOMETRY, lambda _: {"volume": first})
    reserve = exam.serve(f"/{word}_second", GEOMETRY, lambda _: {"volume": second})
    exam.serve(f"/{word}_flat", GEOMETRY, lambda _: {"volume": 0.0})
    exam.serve(f"/{word}_late", GEOMETRY, lambda _: Late(0.6, {"volume": late}))
    exam.serve(f"/{word}_refuses", GEOMETRY, lambda _: Refuse("not today"))
    exam.serve(f"/{word}_frozen", GEOMETRY, lambda _: Silence())
    exam.expect(
        "the preferred one is taken when it answers",
        expected=first,
        seen=_first_of(exam, word, "first", "second").value,
        near=1e-6,
        hints={
            None: NO_RETURN,
            second: "That is the answer of the second one. Stop at the first that answers.",
            (lambda seen: "volume" in seen): "That is the whole response. Return its volume.",
            says(""): "Return the volume that the server answered with.",
        },
    )
    exam.expect(
        "nobody else is bothered then",
        expected=0,
        seen=len(reserve.requests),
        hints="The second was called although the first had answered. Return as soon as you have one.",
    )
    exam.expect(
        "a volume of 0 is an answer, too",
        expected=0.0,
        seen=_first_of(exam, word, "flat", "second").value,
        hints="The first answered with the volume 0.0. Return it: 0.0 counts as False, but it is a volume.",
    )
    for failing in (*exam.draw.shuffled([["nowhere"], ["refuses"]]), ["nowhere", "refuses"]):
        exam.expect(
            "the next one is asked when one fails",
            expected=second,
            seen=_first_of(exam, word, *failing, "second").value,
            near=1e-6,
            hints={None: "The last of them answers. Put try and except inside the loop, and go through all."},
        )
    exam.expect(
        "one that answers within the second is waited for",
        expected=late,
        seen=_first_of(exam, word, "late", "second").value,
        near=1e-6,
        hints={second: "The first answers after 0.6 s, and has a whole second. Wait for it."},
    )
    frozen = _first_of(exam, word, "frozen", "second")
    exam.expect(
        "the next one is asked when one is frozen",
        expected=second,
        seen=frozen.value,
        near=1e-6,
        hints={None: "The second one answers. Go on with it when the first has had its time."},
    )
    exam.hold(
        "a frozen one costs at most about a second",
        frozen.took < 1.75,
        expected="an answer after a good second",
        seen=f"an answer after {frozen.took:.1f} s",
        hints="The limit is one second for each service.",
    )
    exam.expect(
        "None when nobody answers",
        expected=None,
        seen=_first_of(exam, word, "nowhere", "refuses", hints=_NOBODY).value,
        hints="Return None after the loop.",
    )
    sides = exam.draw.numbers(3, 0.5, 9.0)
    names = [f"/{word}_frozen", f"/{word}_second"]
    stops(exam, "first_answer", names, *sides, catch="(rospy.ServiceException, CallTimeout)")


_NOBODY = {says("."): "Nobody answers, and that is no error: return None after the loop."}


def _first_of(exam: Exam, word: str, *kinds: str, hints: Hints = ()) -> Outcome:
    """Run the student's function on the services of these kinds, in this order."""
    return exam.run(
        "first_answer",
        [f"/{word}_{kind}" for kind in kinds],
        *exam.draw.numbers(3, 0.5, 9.0),
        hints=hints
        or {
            says(
                "^ServiceException"
            ): "A failed call must not end the search. Catch rospy.ServiceException inside the loop.",
            says(
                "^TimesUp"
            ): "It waits for a server that never answers. Give the call a limit: node.call(..., timeout=1).",
            says("^CallTimeout"): "The limit worked, and its CallTimeout ended the search. Catch it, too.",
        },
    )
