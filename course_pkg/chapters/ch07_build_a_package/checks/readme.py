"""07.7: a README whose commands show another person how to build, start and call the service."""

from __future__ import annotations

import re

from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY
from course_pkg.checking import CheckContext, part

FILE = MY_GEOMETRY.path("README.md")
BLOCK = re.compile(r"^[ \t]*(?:```|~~~)\w*\n(.*?)^[ \t]*(?:```|~~~)", re.DOTALL | re.MULTILINE)
NUMBER = r"-?\d+(?:\.\d*)?"
FIELD = rf"\w+: *{NUMBER}"
CALL = re.compile(
    rf"rosservice call /?getGeometry\s+(?:--\s+)?"
    rf"(?:{NUMBER}\s+{NUMBER}\s+{NUMBER}|['\"]\{{{FIELD}, *{FIELD}, *{FIELD}\}}['\"])\s*(?:#.*|)"
)
COMMANDS = (  # for each command: a pattern, its name, and the hint
    (
        r"catkin_make\b",
        "catkin_make",
        "The command that builds the package is missing. Write catkin_make on a line of a code block.",
    ),
    (
        r"(?:source|\.) (?:\S*/)?devel/setup\.(?:ba|z)?sh",
        "source devel/setup.bash",
        "The command source devel/setup.bash is missing. A new terminal needs it.",
    ),
    (
        r"rosrun my_geometry server\.py",
        "rosrun my_geometry server.py",
        "The command that starts the server is missing. Write the whole command, from rosrun "
        "to the name of the file.",
    ),
)


@part(
    "07.7",
    points=1,
    goal=(
        "Write README.md: a title, and code blocks with the commands to build the package, source "
        "the workspace, start the server and call the service."
    ),
    needs=[f"file:{FILE}"],
)
def the_readme(context: CheckContext) -> None:
    """Read the title and the commands, and compare the order of the commands."""
    text = context.source(f"file:{FILE}")
    first = text.strip().partition("\n")[0]
    context.require(
        "it begins with a title",
        holds=bool(re.match(r"# \S", first)),
        expected="# and a title",
        actual=first,
        hints="In Markdown, a title is a line that begins with one # and a space.",
    )
    lines = [line.strip().removeprefix("$ ") for block in BLOCK.findall(text) for line in block.splitlines()]
    context.require(
        "it has commands in a code block",
        holds=bool(lines),
        expected="lines between ``` and ```",
        actual="no code block",
        hints="Write a line ``` above the commands, and another line ``` below them.",
    )
    places = [_place(context, lines, *command) for command in COMMANDS]
    places.append(_place_of_call(context, lines))
    context.require(
        "the commands are in the order in which they are typed",
        holds=places == sorted(places),
        expected="build, source, start, call",
        actual=" / ".join(lines[place] for place in sorted(places)),
        hints="Imagine a new terminal: first build, then source, then start the server, and then call it.",
    )


def _place(context: CheckContext, lines: list[str], pattern: str, name: str, hint: str) -> int:
    """Assert that a line has the command `name`; return the number of the first such line."""
    found = [number for number, line in enumerate(lines) if re.search(pattern, line)]
    context.require(
        f"it contains {name}",
        holds=bool(found),
        expected=name,
        actual=" / ".join(lines)[:120],
        hints=hint,
    )
    return found[0]


def _place_of_call(context: CheckContext, lines: list[str]) -> int:
    found = [number for number, line in enumerate(lines) if CALL.search(line)]
    others = [line for line in lines if "rosservice" in line]
    context.require(
        "it shows how to call the service",
        holds=bool(found),
        expected="rosservice call /getGeometry and three numbers",
        actual=" / ".join(others) or "no rosservice call",
        hints="The call needs the name /getGeometry, and one number for each of the three sides."
        if others
        else "Show a call with rosservice, as in step 8.",
    )
    return found[0]
