"""The checks of chapter 06: the student's clients, served by servers that do what a check tells them to."""

from threading import Timer

from course_pkg.examiner import Exam, HangUp, Late, Refuse, Silence, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.scripted import ScriptedServer

GEOMETRY = "course_pkg/geometry"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."


def _volumes(exam: Exam, count: int) -> list[float]:
    """Return volumes that a float32 holds exactly, with a fraction, so that rounding shows."""
    return [whole + 0.375 for whole in exam.draw.integers(count, 1000, 9000)]


@part(
    "06.1",
    points=2,
    goal="Return the area and the volume that the service answers with.",
    needs=["measure"],
)
def the_geometry_client(exam: Exam) -> None:
    """Serve twice, with answers of their own, so that only asking helps."""
    for _ in range(2):
        name = f"/{exam.draw.word()}"
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        area, volume = _volumes(exam, 2)
        server = exam.serve(name, GEOMETRY, lambda _, a=area, v=volume: {"area": a, "volume": v})
        returned = exam.run("measure", name, length, width, height).value
        exam.hold(
            "the service that was named is called",
            bool(server.requests),
            expected=f"a call of {name}",
            seen="no call of it",
            hints="Make the proxy with the name in `service`, and call it with the three sides.",
        )
        exam.expect(
            "it is called once",
            expected=1,
            seen=len(server.requests),
            hints=(
                "Call once and keep the response; each call makes the server work, and makes you wait, again."
            ),
        )
        exam.expect(
            "the request holds length, width and height",
            expected={"length": length, "width": width, "height": height},
            seen=server.requests[0],
            near=1e-4,
            hints={
                (lambda seen: 0.0 in seen.values()): "By name, a field that is left out is 0 without a word.",
                says(""): "The sides arrived in another order than length, width, height.",
            },
        )
        exam.expect(
            "area and volume are returned, in this order",
            expected=[area, volume],
            seen=returned,
            near=1e-6,
            hints=[
                (None, NO_RETURN),
                (
                    {"area": area, "volume": volume},
                    "That is the whole response. Return its area and its volume.",
                ),
                ([volume, area], "That is the volume first."),
                ([length, width], "Those are fields of the request. Read them from the response."),
                (says(""), "This server measures in its own way: return what it says, unchanged."),
            ],
        )


@part(
    "06.2",
    points=2,
    goal="Return whether a service is there, or comes within the given time.",
    needs=["is_there"],
    deadline=20.0,
)
def is_anybody_there(exam: Exam) -> None:
    """Ask for one that is there, two that never answer, and one that comes while the student waits."""
    here, nowhere, killed, later = (f"/{exam.draw.word()}" for _ in range(4))
    exam.serve(here, GEOMETRY, lambda _: {})
    exam.absent(killed, stale=True)
    there = exam.run("is_there", here, 2.0)
    exam.expect(
        "True for a service that is there",
        expected=True,
        seen=there.value,
        hints={
            None: NO_RETURN,
            False: "The service was there. wait_for_service returns nothing when it succeeds.",
        },
    )
    exam.hold(
        "at once for a service that is there",
        there.took < 1.0,
        expected="an answer at once",
        seen=f"an answer after {there.took:.1f} s",
        hints="Return as soon as it is there. wait_for_service does, and waits no longer than it must.",
    )
    _never_there(exam, nowhere, "It said that a service is there that nobody serves.")
    _never_there(
        exam,
        killed,
        "The master still lists this one, but its process is gone. wait_for_service asks the server itself.",
    )
    Timer(1.3, exam.serve, [later, GEOMETRY, lambda _: {}]).start()
    exam.expect(
        "True for a service that comes in time",
        expected=True,
        seen=exam.run("is_there", later, 4.0, within=8.0).value,
        hints={False: "It came after 1.3 s, and there were 4. Wait for as long as `seconds` says."},
    )


def _never_there(exam: Exam, name: str, hint: str) -> None:
    """Give half a second, in which rospy looks twice; three times as long is too long."""
    too_long = "It waited longer than it was told to. Give wait_for_service the limit: timeout=seconds."
    missing = exam.run(
        "is_there",
        name,
        0.5,
        within=3.0,
        hints={
            says("TimesUp"): too_long,
            says(
                "ROSException"
            ): "wait_for_service raises rospy.ROSException when the time is up. Catch that one.",
        },
    )
    exam.expect(
        "False for a service that does not come",
        expected=False,
        seen=missing.value,
        hints={None: "When the time was up, None was returned. Return False there.", True: hint},
    )
    exam.hold(
        "it waits no longer than it is told to",
        missing.took < 1.4,
        expected="an answer after 0.5 s or little more",
        seen=f"an answer after {missing.took:.1f} s",
        hints=too_long,
    )


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
    (volume,) = _volumes(exam, 1)
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
    for slip in ("one metre", 1e300):
        wrong = exam.run("volume_or_none", good, slip, *sides[1:])
        exam.hold(
            "an error of your own comes out",
            bool(wrong.error),
            expected=f"an error about {slip!r}",
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
        hints="Return None when the call failed, so that the caller can tell it from a volume.",
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
    first, second, late = _volumes(exam, 3)
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
        seen=_first_of(exam, word, "nowhere", "refuses").value,
        hints="Return None after the loop.",
    )


def _first_of(exam: Exam, word: str, *kinds: str) -> Outcome:
    """Run the student's function on the services of these kinds, in this order."""
    return exam.run(
        "first_answer",
        [f"/{word}_{kind}" for kind in kinds],
        *exam.draw.numbers(3, 0.5, 9.0),
        hints={
            says(
                "^ServiceException"
            ): "A failed call must not end the search. Catch rospy.ServiceException inside the loop.",
            says(
                "^TimesUp"
            ): "It waits for a server that never answers. Give the call a limit: node.call(..., timeout=1).",
            says("^CallTimeout"): "The limit worked, and its CallTimeout ended the search. Catch it, too.",
        },
    )


@part(
    "06.5",
    points=2,
    goal="Return the three sides from the arguments as numbers, or None.",
    needs=["read_sides"],
)
def read_the_arguments(exam: Exam) -> None:
    """Give good arguments with and without those of ROS, then too few, too many, and no numbers."""
    name_first = "The first argument is the program's own name. The sides start at the second."
    sides = exam.draw.numbers(3, 0.5, 9.0)
    texts = [str(side) for side in sides]
    program = f"/opt/{exam.draw.word()}"
    exam.expect(
        "three numbers are returned",
        expected=sides,
        seen=exam.run(
            "read_sides",
            [program, *texts],
            hints={says("could not convert"): name_first},
        ).value,
        near=1e-9,
        hints={
            None: f"{name_first} And a number may have a point.",
            (
                lambda seen: all(isinstance(item, str) for item in seen)
            ): "Those are texts. Make a float of each.",
            (
                lambda seen: all(isinstance(item, int) for item in seen)
            ): "A side may have a fraction. Make a float of it.",
            says(""): name_first,
        },
    )
    exam.expect(
        "a number may be negative",
        expected=[-sides[0], sides[1], -sides[2]],
        seen=exam.run("read_sides", [program, f"-{texts[0]}", texts[1], f"-{texts[2]}"]).value,
        near=1e-9,
        hints="-1.5 is a number, too: return it as it is. float(text) reads it, and raises when it can't.",
    )
    remapped = [
        program,
        *exam.draw.shuffled([f"__name:={exam.draw.word()}", f"getGeometry:=/{exam.draw.word()}"]),
        *texts,
    ]
    for argv in (remapped, [program, *texts, "__log:=/tmp/x"]):
        exam.expect(
            "arguments for ROS do not count",
            expected=sides,
            seen=exam.run(
                "read_sides",
                argv,
                hints={
                    says(
                        "could not convert"
                    ): "An argument with := in it is for ROS. rospy.myargv(argv) returns the others.",
                },
            ).value,
            near=1e-9,
            hints="An argument with := in it is for ROS. rospy.myargv(argv) returns the others.",
        )
    exam.expect(
        "None when there are too few",
        expected=None,
        seen=exam.run("read_sides", [program, *texts[:2]]).value,
        hints="Two numbers are no box. Return None.",
    )
    exam.expect(
        "None when there are too many",
        expected=None,
        seen=exam.run("read_sides", [program, *texts, "1.0"]).value,
        hints="Four numbers are one too many. Return None, instead of leaving one out without a word.",
    )
    for others in ([texts[0], "wide", texts[2]], [*texts[:2], "wide", texts[2]]):
        exam.expect(
            "None when one is no number",
            expected=None,
            seen=exam.run(
                "read_sides",
                [program, *others],
                hints={
                    says("could not convert"): "float('wide') raises ValueError. Catch it, and return None.",
                },
            ).value,
            hints="A word is no number, and nothing to leave out. Return None.",
        )
