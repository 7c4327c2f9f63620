"""Explain the errors of catkin_make, rosrun and other tools: the fault in a package, and its remedy.

Tables contain patterns of error messages. A pattern matches words that are probably the same in every release
of the tool. The messages come from catkin 0.8.10, CMake 3.25, genmsg 0.6 and the rosbash of Debian 12. The
first row that matches is used. A text of a row can contain the name of a regex group in braces, such as
{name}. The text that the group has matched replaces the name and the braces.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.workspace.cmake_messages import (
    FROM_CMAKE,
    SILENT,
    Message,
    Row,
    cmake_messages,
    unknown_command,
)
from course_pkg.workspace.compiler_messages import compiler_faults
from course_pkg.workspace.fault import Fault
from course_pkg.workspace.tool_messages import FROM_BUILD, FROM_TOOLS

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_MANIFEST = re.compile(r"in package '\S*?/([^/']+)/package\.xml'")
_PATH = re.compile(r"/\S*/src/(?=[\w.+-]+/)")


def explain(output: str) -> Fault | None:
    """Return the first fault in the output of a tool, or None if the output contains no known error.

    If no pattern matches an error of CMake, the fault contains CMake's error message and its line.
    """
    text = _COLOUR.sub("", output).replace("\r\n", "\n")
    return next(_faults(text), None)


def _faults(text: str) -> Iterator[Fault]:
    """Yield faults, in the order from cause to consequence.

    An error of CMake is often only a consequence of another tool's error.
    """
    yield from _matching(FROM_BUILD, text)
    found = list(cmake_messages(text))
    errors = [message for message in found if message.is_error]
    for message in errors:
        yield from _of_cmake(message)
    for message in found:
        yield from _matching(SILENT, message.text, message)
    yield from compiler_faults(text)
    yield from _matching(FROM_TOOLS, text)
    for message in errors:
        yield Fault(
            f"CMake reports: {_shortened(message.text)}",
            "Find the mistake in the line that CMake reports.",
            message.file,
            message.line,
        )


def _of_cmake(message: Message) -> Iterator[Fault]:
    if unknown := re.search(r'Unknown CMake command "(\w+)"', message.text):
        yield unknown_command(unknown[1], message)
    yield from _matching(FROM_CMAKE, message.text, message)


def _matching(table: tuple[Row, ...], text: str, message: Message | None = None) -> Iterator[Fault]:
    for pattern, file, problem, remedy in table:
        if found := re.search(pattern, text, re.DOTALL):
            groups = {name: value or "" for name, value in found.groupdict().items()}
            place = (file.format(**groups), 0) if file or not message else (message.file, message.line)
            if file == "package.xml":
                named = _MANIFEST.search(text)
                place = (f"{named[1]}/package.xml" if named else file, int(groups.get("line") or 0))
            yield Fault(problem.format(**groups), remedy.format(**groups), *place)


def _shortened(message: str) -> str:
    """Return the text of a message, with paths relative to src."""
    return _PATH.sub("", message)
