"""07.7: a README with commands.

With the commands in the README, another person can build the package, start the server, and call the service.
"""

from __future__ import annotations

import re

from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.workspace.fault import without_comments

FILE = MY_GEOMETRY.path("README.md")
BLOCK = re.compile(r"^[ \t]*(?:```|~~~)[^\n`]*\n(.*?)^[ \t]*(?:```|~~~)", re.DOTALL | re.MULTILINE)
# The shell executes no command in lines that match this pattern.
PRINTED = re.compile(r"#|:\s|(?:echo|printf|true)\b")
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)"
FIELDS = ("length", "width", "height")
FIELD = rf"\w+: *{NUMBER}"
CALL = re.compile(
    rf"rosservice +call +(?:(?:-v|--verbose|--wait) +)*/?getGeometry +(?:-- +)?"
    rf"(?:{NUMBER} +{NUMBER} +{NUMBER}|['\"]\{{?\s*{FIELD}(?:(?: *, *|\s+){FIELD}){{2}}\s*\}}?['\"])"
)
CLIENT = re.compile(rf"rosrun +my_geometry +client\.py(?: +{NUMBER}){{3}}")
COMMANDS = (  # Each entry contains the pattern, the name and the hint of a required command.
    (
        r"catkin_make\b(?! +clean)",
        "catkin_make",
        "The command that builds the package is missing. Write catkin_make in a code block, without `clean`.",
    ),
    (
        r"(?:source|\.) +(?:\S*/)?(?:devel|install)/setup\.(?:ba|z)?sh",
        "source devel/setup.bash",
        "The command `source devel/setup.bash` is missing. Write this command in a code block.",
    ),
    (
        r"rosrun +my_geometry +server\.py|(?:python3 +|\./)(?:\S*/)?server\.py",
        "rosrun my_geometry server.py",
        "The command that starts the server is missing. Write the whole command, from `rosrun` "
        "to the name of the file.",
    ),
)


@part(
    "07.7",
    points=1,
    goal=(
        "Write README.md with a title and code blocks. The code blocks contain the commands that "
        "build the package, source the workspace, start the server and call the service."
    ),
    needs=[f"file:{FILE}"],
)
def the_readme(context: CheckContext) -> None:
    """Read the title and the commands, and check the order of the commands."""
    text = context.source(f"file:{FILE}")
    first = text.strip().partition("\n")[0]
    context.require(
        "README.md begins with a title",
        holds=bool(re.match(r"# \S", first)),
        expected="a line with #, a space and a title",
        actual=first,
        hints=[
            (
                matches(r"^#+[^#\s]"),
                "A space is missing after the character # in the first line. Without this space, the line is "
                "not a title.",
            ),
            (ANYTHING, "The title is missing. Write a line that begins with # and a space."),
        ],
    )
    shown = without_comments(text)
    lines = [line.strip().removeprefix("$ ") for block in BLOCK.findall(shown) for line in block.splitlines()]
    commands = "\n".join(line for line in lines if not PRINTED.match(line))
    context.require(
        "README.md contains commands in a code block",
        holds=bool(commands),
        expected="lines between ``` and ```",
        actual="only comments" if any(lines) else "no code block",
        hints=[
            (
                "only comments",
                "In the code block, each line begins with #, so the shell ignores it. Remove the # from "
                "each command.",
            ),
            (
                ANYTHING,
                "The code block is missing. Write a line ``` above the commands, and another line ``` below "
                "them.",
            ),
        ],
    )
    places = [_place(context, commands, *command) for command in COMMANDS]
    places.append(_place_of_call(context, commands, shown))
    context.require(
        "the commands are in the right order",
        holds=places == sorted(places),
        expected="build, source, start, call",
        actual=" / ".join(commands[place:].partition("\n")[0] for place in sorted(places)),
        hints=(
            "The order of the commands is wrong. First build, then source the workspace, then "
            "start the server, and then call the service."
        ),
    )


def _place(context: CheckContext, commands: str, pattern: str, name: str, hint: str) -> int:
    """Assert that the README contains the command `name`; return the position of its first occurrence."""
    found = re.search(pattern, commands)
    context.require(
        f"README.md contains {name}",
        holds=found is not None,
        expected=name,
        actual=commands.replace("\n", " / ")[:120],
        hints=hint,
    )
    return found.start() if found else 0


def _place_of_call(context: CheckContext, commands: str, shown: str) -> int:
    """Assert that the commands call the service; return the position of the call.

    `shown` is the text of the README, without comments.
    """
    found = (CALL if "rosservice call" in commands else CLIENT).search(commands)
    others = [line for line in commands.splitlines() if "rosservice" in line]
    context.require(
        "README.md shows how to call the service",
        holds=found is not None,
        expected="rosservice call /getGeometry and three numbers",
        actual=" / ".join(others) or "no rosservice call",
        hints="A part of the command that calls the service is missing. Write the name /getGeometry, and "
        "one number for each of the three sides."
        if others
        else "The command that calls the service is in the text, not in a code block. Write this command on "
        "a separate line between two lines with ```."
        if CALL.search(shown)
        else "The call of the service is missing. Write the rosservice command from step 8.",
    )
    names = re.findall(r"(\w+):", found[0]) if found else []
    context.require(
        "README.md shows how to call the service",
        holds=not names or sorted(names) == sorted(FIELDS),
        expected="the fields length, width and height",
        actual=", ".join(names),
        hints="The command that calls the service has wrong names of fields, so rosservice refuses it. "
        "Write the names of the fields of the request.",
    )
    return found.start() if found else 0
