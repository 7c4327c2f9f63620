"""The messages of CMake in what a build printed, and the commands in a CMakeLists.txt.

CMake breaks its messages into lines of some 75 characters, wherever the length of a path makes it, and names
the file that complained; which of the student's lines led there stands in the call stack below.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

_HEAD = re.compile(
    r"CMake (?P<kind>Error|Warning)(?: \(dev\))?"
    r"(?: at (?P<file>.+?):(?P<line>\d+)(?: \(\w+\))?)?:(?P<rest>.*)"
)
# catkin's own top-level file is named without a folder, and what lies elsewhere with its whole path.
_OURS = re.compile(r"(?P<file>[\w.+-]+(?:/[\w.+-]+)*/CMakeLists\.txt):(?P<line>\d+)")
_STACK = "Call Stack (most recent call first):"
_COMMAND = re.compile(r"(?P<comment>#\s*)?(?P<name>[A-Za-z_]\w*)[ \t]*\(")


@dataclass(frozen=True)
class Message:
    """One message: its words in one line, and the line of a package's CMakeLists.txt that led to it."""

    words: str
    file: str
    line: int
    is_error: bool


@dataclass(frozen=True)
class Command:
    """A command in a CMakeLists.txt, and the line that it begins in."""

    name: str
    line: int
    is_comment: bool


def messages(output: str) -> Iterator[Message]:
    """Yield the errors and warnings of CMake in what a build printed, in their order."""
    lines = output.splitlines()
    for number, line in enumerate(lines):
        if head := _HEAD.match(line):
            yield _message(head, lines[number + 1 :])


def _message(head: re.Match[str], below: list[str]) -> Message:
    body = list(_indented(below))
    split = body.index(_STACK) if _STACK in body else len(body)
    words = " ".join(" ".join([head["rest"], *body[:split]]).split())
    places = [f"{head['file']}:{head['line']}", *body[split + 1 :]]
    ours = next((found for place in places if (found := _OURS.match(place.strip()))), None)
    is_error = head["kind"] == "Error"
    return (
        Message(words, ours["file"], int(ours["line"]), is_error) if ours else Message(words, "", 0, is_error)
    )


def _indented(lines: list[str]) -> Iterator[str]:
    """Yield the lines of a message: those that are indented, blank ones between them, and its call stack."""
    for line in lines:
        if line.strip() and not line.startswith("  ") and line.strip() != _STACK:
            return
        yield line.strip()


def commands(text: str) -> Iterator[Command]:
    """Yield the commands of a CMakeLists.txt, those that are only a comment included."""
    for number, line in enumerate(text.splitlines(), 1):
        if found := _COMMAND.match(line.strip()):
            yield Command(found["name"].lower(), number, bool(found["comment"]))
