"""The lines of a .srv or .msg text: the declaration in each line, and its comments.

The rules for a definition are from genmsg (wiki.ros.org/msg, wiki.ros.org/srv). The text must be valid. The
module `diagnosis` explains the mistakes in an invalid text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

SEPARATOR = "---"
_WORD = re.compile(r"[^ ]+")


@dataclass(frozen=True)
class Word:
    """A word of a line; `column` counts from 1."""

    text: str
    column: int


@dataclass(frozen=True)
class Line:
    """A line of a definition; `number` counts from 1."""

    number: int
    text: str

    @property
    def code(self) -> str:
        """The text before the comment."""
        # The value of a string constant is all text after its equals sign, even if the text contains a #.
        if self.text.lstrip().startswith("string ") and "=" in self.text.split("#")[0]:
            return self.text
        return self.text.split("#")[0]

    @property
    def comment(self) -> str:
        """The text after the #."""
        return self.text[len(self.code) + 1 :].strip()

    @property
    def is_constant(self) -> bool:
        """Whether the line declares a constant."""
        return "=" in self.text.split("#")[0]

    @property
    def is_separator(self) -> bool:
        """Whether genmsg treats the line as the separator between request and response."""
        return self.text.startswith(SEPARATOR)

    def words(self) -> list[Word]:
        """Return the tokens before the comment; genmsg splits at spaces, never at tabs."""
        found = ((each[0], each.start()) for each in _WORD.finditer(self.code.rstrip()))
        return [
            Word(text.strip(), start + 1 + len(text) - len(text.lstrip()))
            for text, start in found
            if text.strip()
        ]


def lines(text: str) -> Iterator[Line]:
    """Yield the lines of a definition."""
    for number, line in enumerate(with_unix_line_ends(text).split("\n"), start=1):
        yield Line(number, line)


def with_unix_line_ends(text: str) -> str:
    """Return the text with the line endings of Linux. In a build, Python's open() makes the same change."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


@dataclass(frozen=True)
class Comments:
    """The comments in a message's definition: one for the whole message, and one per field name."""

    whole: str
    fields: dict[str, str]


def comments(text: str) -> Comments:
    """Return the comment at the top, and the comments after a field or directly above it."""
    entries = list(lines(text))
    start = next((index for index, line in enumerate(entries) if line.text.strip()), 0)
    top = _leading_comment(entries[start:])
    found: dict[str, str] = {}
    above: list[str] = []
    for line in entries[start + len(top) :]:
        words = line.words()
        if len(words) == 2 and not line.is_constant:
            found[words[1].text] = line.comment or _joined(above)
        if not words and line.comment:
            above.append(line.comment)
        else:
            above = []
    return Comments(_joined(line.comment for line in top), found)


def _leading_comment(entries: list[Line]) -> list[Line]:
    """Return the comment lines at the beginning."""
    block = []
    for line in entries:
        if not line.text.lstrip().startswith("#"):
            break
        block.append(line)
    return block


def _joined(comment_lines: Iterable[str]) -> str:
    return " ".join(line.strip("# \t") for line in comment_lines).strip()
