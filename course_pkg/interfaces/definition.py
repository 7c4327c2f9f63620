"""The lines of a .srv or .msg text: what each declares, and the comments on it.

Follows genmsg's reading (wiki.ros.org/msg, wiki.ros.org/srv) and expects a text
that it accepts; `diagnosis` says what is wrong with one that it does not.
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
    """A line of a definition; `number` counts from 1, `words` are those in front of the comment."""

    number: int
    text: str

    @property
    def code(self) -> str:
        """What stands in front of the comment."""
        # A string constant takes everything behind its equals sign, the # included.
        if self.text.lstrip().startswith("string ") and "=" in self.text.split("#")[0]:
            return self.text
        return self.text.split("#")[0]

    @property
    def comment(self) -> str:
        """What stands behind the #."""
        return self.text[len(self.code) + 1 :].strip()

    @property
    def is_constant(self) -> bool:
        """Whether it declares a constant."""
        return "=" in self.text.split("#")[0]

    @property
    def is_separator(self) -> bool:
        """Whether genmsg takes it for the line between request and response."""
        return self.text.startswith(SEPARATOR)

    def words(self) -> list[Word]:
        """Return the words as genmsg parts them: at spaces, never at tabs."""
        found = ((each[0], each.start()) for each in _WORD.finditer(self.code.rstrip()))
        return [
            Word(text.strip(), start + 1 + len(text) - len(text.lstrip()))
            for text, start in found
            if text.strip()
        ]


def lines(text: str) -> Iterator[Line]:
    """Yield the lines of a definition."""
    for number, line in enumerate(unix(text).split("\n"), start=1):
        yield Line(number, line)


def unix(text: str) -> str:
    """Return the text with line ends as Python's open() gives them to the builder."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def halves(text: str) -> tuple[str, str]:
    """Return the texts of request and response, as genmsg parts them."""
    parts: tuple[list[str], list[str]] = ([], [])
    half = 0
    for line in lines(text):
        if line.is_separator:
            half = 1
        else:
            parts[half].append(line.text)
    return "\n".join(parts[0]), "\n".join(parts[1])


@dataclass(frozen=True)
class Comments:
    """What the comments of a message's text say: of the whole, and of each field."""

    whole: str
    fields: dict[str, str]


def comments(text: str) -> Comments:
    """Return the comment at the top, and for each field the one behind it or right above it."""
    entries = list(lines(text))
    start = next((index for index, line in enumerate(entries) if line.text.strip()), 0)
    top = _block(entries[start:])
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


def _block(entries: list[Line]) -> list[Line]:
    """Return the lines at the beginning that are nothing but comment."""
    block = []
    for line in entries:
        if not line.text.lstrip().startswith("#"):
            break
        block.append(line)
    return block


def _joined(comment_lines: Iterable[str]) -> str:
    return " ".join(line.strip("# \t") for line in comment_lines).strip()
