"""What catkin_make, rosrun and the like print when a package is wrong, and what to do about it.

Text in, explanation out. A row matches on words that are the same in every release (seen with catkin 0.8.10,
CMake 3.25, genmsg 0.6 and rosbash of Debian 12); the first row that matches counts. What is in braces stands
for what the pattern found.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.building.cmake import Message, messages
from course_pkg.building.cmake_table import FROM_CMAKE, SILENT, Row, unknown_command
from course_pkg.building.compiler import compiler_faults
from course_pkg.building.fault import Fault
from course_pkg.building.tool_tables import FROM_BUILD, FROM_TOOLS

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_MANIFEST = re.compile(r"in package '\S*?/([^/']+)/package\.xml'")
_PATH = re.compile(r"/\S*/src/(?=[\w.+-]+/)")


def explain(output: str) -> Fault | None:
    """Return the first fault in what a tool printed, None where nothing is known to be wrong in it.

    A message of CMake that is in no table comes back in its own words, with the line that it is about.
    """
    text = _COLOUR.sub("", output).replace("\r\n", "\n")
    return next(_faults(text), None)


def _faults(text: str) -> Iterator[Fault]:
    """Yield faults, the telling ones first: CMake's own errors often only follow from another tool's."""
    yield from _matching(FROM_BUILD, text)
    found = list(messages(text))
    errors = [message for message in found if message.is_error]
    for message in errors:
        yield from _of_cmake(message)
    for message in found:
        yield from _matching(SILENT, message.words, message)
    yield from compiler_faults(text)
    yield from _matching(FROM_TOOLS, text)
    for message in errors:
        yield Fault(
            f"CMake says: {_shortened(message.words)}", "Look at that line.", message.file, message.line
        )


def _of_cmake(message: Message) -> Iterator[Fault]:
    if unknown := re.search(r'Unknown CMake command "(\w+)"', message.words):
        yield unknown_command(unknown[1], message)
    yield from _matching(FROM_CMAKE, message.words, message)


def _matching(table: tuple[Row, ...], text: str, message: Message | None = None) -> Iterator[Fault]:
    for pattern, file, problem, remedy in table:
        if found := re.search(pattern, text, re.DOTALL):
            words = {name: value or "" for name, value in found.groupdict().items()}
            place = (file.format(**words), 0) if file or not message else (message.file, message.line)
            if file == "package.xml":
                named = _MANIFEST.search(text)
                place = (f"{named[1]}/package.xml" if named else file, int(words.get("line") or 0))
            yield Fault(problem.format(**words), remedy.format(**words), *place)


def _shortened(words: str) -> str:
    """Return a message with its paths cut down to what lies below src."""
    return _PATH.sub("", words)
