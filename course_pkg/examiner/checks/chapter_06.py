"""The checks of chapter 06: the student's clients, served by servers that do what a check tells them to."""

from threading import Timer

from course_pkg.examiner import Exam, HangUp, Refuse, Silence, part, says

GEOMETRY = "course_pkg/geometry"
NO_RETURN = "The function came to its end without a return line."


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
        area, volume = exam.draw.numbers(2, 1000.0, 9000.0)
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
            near=1e-4,
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
    """Ask for one that is there, one that never comes, and one that comes while the student waits."""
    here, nowhere, later = (f"/{exam.draw.word()}" for _ in range(3))
    exam.serve(here, GEOMETRY, lambda _: {})
    hints = {
        None: NO_RETURN,
        False: "The service was there. wait_for_service returns nothing when it succeeds.",
    }
    exam.expect(
        "True for a service that is there",
        expected=True,
        seen=exam.run("is_there", here, 2.0).value,
        hints=hints,
    )
    missing = exam.run(
        "is_there",
        nowhere,
        1.0,
        within=5.0,
        hints={
            says(
                "TimesUp"
            ): "It waited longer than it was told to. Give wait_for_service the limit: timeout=seconds.",
            says(
                "ROSException"
            ): "wait_for_service raises rospy.ROSException when the time is up. Catch that one.",
        },
    )
    exam.expect(
        "False for a service that does not come",
        expected=False,
        seen=missing.value,
        hints={
            None: "When the time was up, the function returned nothing. Return False there.",
            True: "It said that a service is there that nobody serves.",
        },
    )
    Timer(0.7, exam.serve, [later, GEOMETRY, lambda _: {}]).start()
    seen = exam.run("is_there", later, 4.0, within=8.0).value
    exam.expect(
        "True for a service that comes in time",
        expected=True,
        seen=seen,
        hints={
            False: "It came after 0.7 s, and there were 4. Wait for it, instead of looking once.",
        },
    )


@part(
    "06.3",
    points=2,
    goal="Return the volume, or None if the call failed; let errors of your own come out.",
    needs=["volume_or_none"],
    deadline=20.0,
)
def catch_what_can_happen(exam: Exam) -> None:
    """Try a good server, four that fail each in its own way, and one wrong argument."""
    good = f"/{exam.draw.word()}"
    sides = exam.draw.numbers(3, 0.5, 9.0)
    volume = exam.draw.number(1000.0, 9000.0)
    exam.serve(good, GEOMETRY, lambda _: {"volume": volume})
    returned = exam.run("volume_or_none", good, *sides).value
    exam.expect(
        "the volume of the answer is returned",
        expected=volume,
        seen=returned,
        near=1e-4,
        hints={
            None: "The server answered, and None was returned.",
            says(""): "Return the volume that the server answered with.",
        },
    )
    for failure, name in _failing(exam):
        outcome = exam.run(
            "volume_or_none",
            name,
            *sides,
            hints={
                says(
                    "ServiceException"
                ): "A call that fails raises rospy.ServiceException, no rospy.ROSException. Catch that one.",
            },
        )
        exam.expect(
            f"None from a server that {failure}",
            expected=None,
            seen=outcome.value,
            hints=("Return None when the call failed, so that the caller can tell it from a volume."),
        )
    wrong = exam.run("volume_or_none", good, "one metre", *sides[1:])
    exam.hold(
        "an error of your own comes out",
        bool(wrong.error),
        expected="an error about 'one metre'",
        seen=wrong.error or "no error",
        hints=("A slip in your own program was hidden. Catch rospy.ServiceException, and nothing wider."),
    )


def _failing(exam: Exam) -> list[tuple[str, str]]:
    """Return pairs of what a server does and the name at which one does it."""
    name = exam.draw.word()
    exam.serve(f"/{name}_refuses", GEOMETRY, lambda _: Refuse("not today"))
    exam.serve(f"/{name}_dies", GEOMETRY, lambda _: HangUp())
    exam.absent(f"/{name}_killed", stale=True)
    return [
        ("is not there", f"/{name}_nowhere"),
        ("refuses", f"/{name}_refuses"),
        ("dies during the call", f"/{name}_dies"),
        ("was killed", f"/{name}_killed"),
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
    sides = exam.draw.numbers(3, 0.5, 9.0)
    first, second = exam.draw.numbers(2, 1000.0, 9000.0)
    exam.serve(f"/{word}_first", GEOMETRY, lambda _: {"volume": first})
    reserve = exam.serve(f"/{word}_second", GEOMETRY, lambda _: {"volume": second})
    exam.serve(f"/{word}_refuses", GEOMETRY, lambda _: Refuse("not today"))
    exam.serve(f"/{word}_frozen", GEOMETRY, lambda _: Silence())
    both = [f"/{word}_first", f"/{word}_second"]
    seen = exam.run("first_answer", both, *sides).value
    exam.expect(
        "the preferred one is taken when it answers",
        expected=first,
        seen=seen,
        near=1e-4,
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
        hints=("The second was called although the first had answered. Return as soon as you have one."),
    )
    for failure in exam.draw.shuffled(["nowhere", "refuses"]):
        outcome = exam.run(
            "first_answer",
            [f"/{word}_{failure}", f"/{word}_second"],
            *sides,
            hints={
                says(
                    "ServiceException"
                ): "A failed call must not end the search. Catch rospy.ServiceException inside the loop.",
            },
        )
        exam.expect(
            "the next one is asked when one fails",
            expected=second,
            seen=outcome.value,
            near=1e-4,
            hints={
                None: "It gave up after the first. Put try and except inside the loop.",
            },
        )
    frozen = exam.run(
        "first_answer",
        [f"/{word}_frozen", f"/{word}_second"],
        *sides,
        within=6.0,
        hints={
            says(
                "TimesUp"
            ): "It waits for a server that never answers. Give the call a limit: node.call(..., timeout=1).",
            says("CallTimeout"): "The limit worked, and its CallTimeout ended the search. Catch it, too.",
        },
    )
    exam.expect(
        "the next one is asked when one is frozen",
        expected=second,
        seen=frozen.value,
        near=1e-4,
        hints={
            None: "It gave up after the frozen one. Go on with the next.",
        },
    )
    exam.hold(
        "a frozen one costs at most about a second",
        frozen.took < 2.5,
        expected="an answer after a good second",
        seen=f"an answer after {frozen.took:.1f} s",
        hints="The limit is one second for each service.",
    )
    none = exam.run("first_answer", [f"/{word}_nowhere", f"/{word}_refuses"], *sides)
    exam.expect(
        "None when nobody answers", expected=None, seen=none.value, hints="Return None after the loop."
    )


@part(
    "06.5",
    points=2,
    goal="Return the three sides from the arguments as numbers, or None.",
    needs=["read_sides"],
)
def read_the_arguments(exam: Exam) -> None:
    """Give good arguments with and without those of ROS, then too few, too many, and no numbers."""
    sides = exam.draw.numbers(3, 0.5, 9.0)
    texts = [str(side) for side in sides]
    program = f"/opt/{exam.draw.word()}"
    exam.expect(
        "three numbers are returned",
        expected=sides,
        seen=exam.run(
            "read_sides",
            [program, *texts],
            hints={
                says(
                    "could not convert"
                ): "The first argument is the program's own name. The sides start at the second.",
            },
        ).value,
        near=1e-9,
        hints={
            None: "The first argument is the program's own name. The sides start at the second.",
            (
                lambda seen: all(isinstance(item, str) for item in seen)
            ): "Those are texts. Make a float of each.",
            (
                lambda seen: all(isinstance(item, int) for item in seen)
            ): "A side may have a fraction. Make a float of it.",
            says(""): "The first argument is the program's own name. The sides start at the second.",
        },
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
    exam.expect(
        "None when one is no number",
        expected=None,
        seen=exam.run(
            "read_sides",
            [program, texts[0], "wide", texts[2]],
            hints={
                says("could not convert"): "float('wide') raises ValueError. Catch it, and return None.",
            },
        ).value,
        hints="A word is no number. Return None.",
    )
