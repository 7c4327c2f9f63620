"""08.4: a command line that calls a service. bash splits the line into words, and YAML reads the fields."""

from __future__ import annotations

import shlex
from contextlib import suppress

from course_pkg.chapters.ch08_use_existing_services.checks.example_calls import ExampleCall, example_calls
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints, hint_for
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.plain_values import Fields, of_kind
from course_pkg.checking.shared.command_line import commands_of, substitutes
from course_pkg.ros.protocol.json_channel import Json

PRINTS = (["echo"], ["printf"])
# A right command line has this many words: rosservice, call, the name, and one word with all fields.
WORDS = 4
SPLIT = (
    "bash has split the fields at spaces, or has removed quotes. Use shlex.quote: bash reads the "
    "result as one word without any change."
)
TYPES = (
    "YAML read a value that differs from the value in the dict. Use json.dumps, which writes a dict in a "
    "form that YAML reads correctly."
)
LOST = "A field in an inner dict has no value. Write the whole dict into the line."
REPLACED = (
    "bash has replaced $HOME with a path. Use shlex.quote: it writes single quotes, and bash replaces "
    "no variable inside single quotes."
)
NO_YAML = "YAML cannot read a dict from the fields in your line. Use json.dumps, and then shlex.quote."
CALLED_BEFORE = (
    "Your function called the service. Return the line as a string, because the check runs the line."
)
TWICE = "The line calls the service more than once. Write only one call."
COMPLAINTS = [
    (
        matches(r"call \S+ \w+:="),
        "ROS reads an argument with := as a remapping, so rosservice does not receive this argument. "
        "Write the fields as a dict.",
    ),
    (
        matches(r"call \S+ \w+="),
        ("YAML reads a=5 as a string, not as a field. Write the fields as a dict: {a: 5}."),
    ),
    (
        matches("^!"),
        "The character ! works only in a cell of a notebook. Remove this character, because "
        "the line is for a terminal.",
    ),
    (
        matches("syntax error"),
        "Your line is a function call in Python. For a terminal, write the command without "
        "parentheses, and write spaces between the words.",
    ),
    (
        matches("no such file"),
        "Because of the quotes, bash reads the whole line as one word. Write quotes only around the fields.",
    ),
    (matches(r"\{.*no such option"), SPLIT),
    (
        matches("no such option"),
        "rosservice reads -5 as an option. Write -- before the values, or write the values as a dict.",
    ),
    (matches("EOF while|unmatched|not found|ParserError|ScannerError|Not enough|Too many"), SPLIT),
    (matches("incorrect type|has no len"), TYPES),
    (
        matches("not available"),
        "The name of the service in your line is wrong. Use the name in the variable `service`.",
    ),
    (
        matches("no output, and no call"),
        "rosservice received no values. Write the fields after the name of the service.",
    ),
]


NO_LINE: Hints = [
    (None, NO_RETURN),
    (
        (lambda actual: isinstance(actual, list)),
        "Your function returned a list of words. Return one string with spaces between the words.",
    ),
    (matches("object|success"), CALLED_BEFORE),
    (ANYTHING, "The command is missing in your line. Write `rosservice call` at the beginning."),
]


@part(
    "08.4",
    points=2,
    goal=(
        "Return a command line for a terminal. The line uses `rosservice call` to call the service "
        "with the given fields."
    ),
    needs=["call_line"],
    deadline=38.0,
)
def line_for_a_terminal(context: CheckContext) -> None:
    """In bash, run the command lines that the student's function returns.

    Some values need quotes for bash or YAML.
    """
    for example in example_calls(context):
        name = f"/{context.random.word()}"
        server = context.serve(name, example.kind, lambda _, answer=example.answer: answer)
        line = context.run("call_line", name, example.fields).returned()
        if server.requests:
            context.fail(
                "the returned string contains `rosservice call`",
                expected="no call of the service before the check runs the line",
                actual=f"{len(server.requests)} call(s)",
                hint=CALLED_BEFORE,
            )
        context.require(
            "the returned string contains `rosservice call`",
            holds=isinstance(line, str) and "rosservice call" in line,
            expected="a string such as 'rosservice call /name …'",
            actual=line,
            hints=NO_LINE,
        )
        _runs(context, example, server, of_kind(str, line, "the line"))


def _is_call(line: Json) -> bool:
    """Return whether the line runs `rosservice call`; a pipe from echo or printf may supply the fields."""
    *before, last = commands_of(line) or [[]]
    return last[:2] == ["rosservice", "call"] and all(words[:1] in PRINTS for words in before)


def _runs(context: CheckContext, example: ExampleCall, server: ScriptedServer, line: str) -> None:
    """Assert that the line makes exactly one call, with the right fields."""
    finished = context.command("bash", "-c", line, within=12.0)
    output = f"{finished.out}\n{finished.err}".strip() or "no output, and no call"
    context.require(
        f"{example.what}: the line calls the service",
        holds=finished.status == 0 and len(server.requests) == 1,
        expected="one call, and no error message",
        actual=_decisive_lines(output),
        hints=TWICE if len(server.requests) > 1 else _complaint(line, output),
    )
    if not _is_call(line) or substitutes(line):
        context.fail(
            "the returned string contains `rosservice call`",
            expected="only one command, which is rosservice call",
            actual=line,
            hint=(
                "A different program calls the service, not rosservice. Write a line that contains "
                "only one `rosservice call` command."
            ),
        )
    context.expect(
        f"{example.what}: the server receives the given values",
        expected=example.fields,
        actual=example.given(server.requests[0]),
        hints=[
            (
                example.mixed_up,
                "The values are in the wrong fields, because rosservice assigns the values in the "
                "order of the fields in the type. Write a dict with the names of the fields.",
            ),
            (_lost, LOST),
            (lambda actual: "$HOME" in str(example.fields) and "$HOME" not in str(actual), REPLACED),
            (ANYTHING, TYPES),
        ],
    )


def _lost(actual: Fields) -> bool:
    return not actual["camera_info"]["width"]


def _complaint(line: str, output: str) -> str:
    """Return the hint for a line that did not call the service."""
    with suppress(ValueError):  # shlex.split raises ValueError if a quotation mark is not closed.
        if len(shlex.split(line)) == WORDS and matches("ParserError|ScannerError|Too many").search(output):
            return NO_YAML
    return hint_for(COMPLAINTS, f"{line}\n{output}")


def _decisive_lines(output: str) -> str:
    """Return the first line with an error and the next line, or the last line if no line has an error."""
    lines = output.splitlines()
    first = next((number for number, text in enumerate(lines) if matches("^error|error:").search(text)), -1)
    return "\n".join(lines[first:][:2])
