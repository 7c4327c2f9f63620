"""The client as a program, with arguments on the command line."""

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import same

LONGER = """
def longer(function, argv, number):
    numbers = function(argv)
    numbers.append(number)
    return numbers
"""  # A check receives a tuple as a list, but code in the kernel can append a number only to a list.
FOR_ROS = "ROS uses the arguments that contain :=. Use rospy.myargv(argv), which returns all other arguments."
NUMBERS = "Return the three numbers as a list, and ignore arguments for ROS."


@part(
    "06.5",
    points=2,
    goal=(
        "Read three numbers from the list of arguments, and return these numbers. Return None if "
        "there are not exactly three numbers."
    ),
    needs=["read_sides"],
    goals=[NUMBERS, "Return None if there are not exactly three numbers."],
)
def read_the_arguments(context: CheckContext) -> None:
    """Call the student's function with valid arguments, without and with additional arguments for ROS.

    Later, call the student's function with too few numbers, with too many numbers, and with a word.
    """
    name_first = (
        "The first item of the list is the name of the program. Skip this item when you read the sides."
    )
    sides = context.random.numbers(3, 0.5, 9.0)
    texts = [str(side) for side in sides]
    program = f"/opt/{context.random.word()}"
    context.expect(
        "three numbers are returned",
        expected=sides,
        actual=context.run(
            "read_sides",
            [program, *texts],
            hints=[(matches("could not convert"), name_first)],
        ).returned(),
        near=1e-9,
        hints=[
            (
                None,
                "The function returned None, although `argv` contains three numbers after the name "
                "of the program. Read only `argv`, and note that 1.5 is a number, too.",
            ),
            (
                lambda actual: all(isinstance(item, str) for item in actual),
                "The function returned strings. Convert each string to float.",
            ),
            (
                lambda actual: all(isinstance(item, int) for item in actual),
                "A side can be a number such as 1.5. Convert each side to float, not to int.",
            ),
            (
                lambda actual: not {*actual} & {*sides},
                "The function returned numbers that are not in `argv`. Convert the strings in `argv` "
                "to float, and return these numbers.",
            ),
            (ANYTHING, name_first),
        ],
    )
    context.expect(
        "a number may be negative",
        expected=[-sides[0], sides[1], -sides[2]],
        actual=context.run("read_sides", [program, f"-{texts[0]}", texts[1], f"-{texts[2]}"]).returned(),
        near=1e-9,
        hints=(
            "-1.5 is a number, too, so return it unchanged. Use float(text), which raises "
            "ValueError only if the text is not a number."
        ),
    )
    whole = context.random.integer(1, 99)
    context.expect(
        "a number needs no point",
        expected=[whole, 0.25, whole * 10],
        actual=context.run("read_sides", [program, f"{whole}", "25e-2", f"{whole}e1"]).returned(),
        near=1e-9,
        hints=(
            f"{whole} and 25e-2 are numbers, too. Do not test the characters of an argument: use "
            "float(text), which raises ValueError only if the text is not a number."
        ),
    )
    remapped = [
        program,
        *context.random.shuffled(
            [f"__name:={context.random.word()}", f"getGeometry:=/{context.random.word()}"]
        ),
        *texts,
    ]
    private = f"_{context.random.word()}:={context.random.integer(1, 9)}"
    other = f"{context.random.word()}:=/{context.random.word()}"
    for argv in (remapped, [program, *texts, "__log:=/tmp/x"], [program, private, *texts, other]):
        context.expect(
            "arguments for ROS are ignored",
            expected=sides,
            actual=context.run(
                "read_sides",
                argv,
                hints=[
                    (
                        matches("could not convert"),
                        FOR_ROS,
                    )
                ],
            ).returned(),
            near=1e-9,
            hints=FOR_ROS,
        )
    context.fulfilled(NUMBERS)
    context.expect(
        "the function returns None for fewer than three numbers",
        expected=None,
        actual=context.run("read_sides", [program, *texts[:2]], hints=_ENDS).returned(),
        hints="Two numbers are not enough. Return None in this case.",
    )
    context.expect(
        "the function returns None for more than three numbers",
        expected=None,
        actual=context.run("read_sides", [program, *texts, "1.0"], hints=_ENDS).returned(),
        hints="Four numbers are too many. Return None, and do not ignore the fourth number.",
    )
    for others in (
        [texts[0], "wide", texts[2]],
        [*texts[:2], "wide", texts[2]],
        [texts[0], f"float({texts[1]})", texts[2]],
        [*texts[:2], f"{texts[2]}m"],
        ["True", *texts[1:]],
    ):
        context.expect(
            "the function returns None if an argument is not a number",
            expected=None,
            actual=context.run(
                "read_sides",
                [program, *others],
                hints=[
                    (
                        matches("could not convert"),
                        "float('wide') raises ValueError. Catch this exception, and return None.",
                    ),
                    (
                        matches("SyntaxError"),
                        "Python evaluated an argument such as 5m as code. Convert each argument with "
                        "float(text), which raises ValueError for every text that is not a number.",
                    ),
                ],
            ).returned(),
            hints=[
                (
                    [1.0, *sides[1:]],
                    "The argument True is a word, but the function returned the number 1. Convert the text "
                    "with float(text), and do not evaluate the text as Python code.",
                ),
                (ANYTHING, "One argument is a word. Return None, and do not ignore the word."),
            ],
        )
    _in_a_random_order(context, program)
    context.prepare(LONGER)
    fourth = context.random.integer(10, 99)
    its = Its("read_sides"), [program, *texts], fourth
    context.require(
        "three numbers are returned",
        holds=same([*sides, fourth], context.run("longer", *its, worded="read_sides()").value, 1e-9),
        expected="a list of three numbers",
        actual="three numbers, but not in a list",
        hints="The numbers are right, but they are not in a list. Return a list, not a tuple.",
    )


def _in_a_random_order(context: CheckContext, program: str) -> None:
    """Use valid and invalid arguments in a random order; a function with a fixed list of results fails."""
    counts = [3] * context.random.integer(2, 4) + [2] * context.random.integer(1, 2) + [4, 5]
    for count in context.random.shuffled(counts):
        numbers = context.random.numbers(count, 0.5, 9.0)
        context.expect(
            {
                2: "the function returns None for fewer than three numbers",
                3: "three numbers are returned",
            }.get(count, "the function returns None for more than three numbers"),
            expected=numbers if count == 3 else None,
            actual=context.run("read_sides", [program, *map(str, numbers)], hints=_ENDS).returned(),
            near=1e-9,
            hints=(
                "The result has to depend on the arguments of this call, not on earlier calls. "
                "Read the numbers from `argv` in each call."
            ),
        )


_ENDS = [
    (matches("^SystemExit"), "The function ends the program. Return None, and do not call sys.exit."),
    (
        matches("."),
        "The function raised an exception for a wrong number of arguments. Return None in this case.",
    ),
]
