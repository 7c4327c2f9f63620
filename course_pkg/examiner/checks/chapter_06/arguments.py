"""The client as a program: what stands on its command line."""

from course_pkg.examiner import Exam, part, says


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
            None: f"{name_first} And a number may have a point. They stand in `argv`: rospy.myargv(argv).",
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
        seen=exam.run("read_sides", [program, *texts[:2]], hints=_ENDS).value,
        hints="Two numbers are no box. Return None.",
    )
    exam.expect(
        "None when there are too many",
        expected=None,
        seen=exam.run("read_sides", [program, *texts, "1.0"], hints=_ENDS).value,
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


_ENDS = {
    says("^SystemExit"): "It ends the program. What to do then is for the caller to say: return None.",
    says("."): "Other than three is no error here: return None.",
}
