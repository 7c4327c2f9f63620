"""Removes nbval's markers and cell magics from a student's code, because both change how the cell runs.

If any line contains a comment such as `# NBVAL_SKIP`, nbval treats the cell differently. If the first line is
a cell magic, IPython passes the whole cell to this magic. Such a comment or magic could prevent the check of
a student's answer.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, cast

from IPython.core.inputtransformer2 import TransformerManager

MARKERS = (  # The markers are listed as comment_markers in plugin.py of nbval 0.11.
    "PYTEST_VALIDATE_IGNORE_OUTPUT",
    "NBVAL_IGNORE_OUTPUT",
    "NBVAL_CHECK_OUTPUT",
    "NBVAL_RAISES_EXCEPTION",
    "NBVAL_SKIP",
)
TAGS = (*(marker.lower().replace("_", "-") for marker in MARKERS), "raises-exception", "skip-execution")
WRITES = re.compile(r"%%(?:writefile|file)\s+(?:-a\s+|--append\s+)?(?P<path>.*?)\s*")


Transform: TypeAlias = Callable[[list[str]], list[str]]


@dataclass(frozen=True)
class Defused:
    """An answer's code without markers and magics, and notes for the student about the changes."""

    source: str
    notes: tuple[str, ...] = ()


def defuse(source: str, first_line: str = "") -> Defused:
    """Return the code of an answer without nbval's markers and without cell magics.

    `first_line` is the cell magic (%%…) that the exercise needs, or an empty string.
    """
    kept, notes = _readable(source)
    kept, about_magic = _with_magic(kept, first_line) if first_line else _without_magic(kept)
    kept, about_markers = _without_markers(kept)
    return Defused(kept, (*notes, *about_magic, *about_markers))


def magic_of(source: str) -> str:
    """Return the first line if it is a magic to which IPython passes the whole cell; otherwise, return ""."""
    return first[0].strip() if (first := _as_ipython_reads(source)) and first[0].startswith("%%") else ""


def _readable(source: str) -> tuple[str, list[str]]:
    """Return the source without characters that a Python file or UTF-8 cannot contain."""
    kept = source.replace("\r\n", "\n").replace("\r", "\n").replace("\x00", "")
    kept = kept.encode("utf-8", "replace").decode("utf-8")  # A question mark replaces a surrogate.
    if kept != source.replace("\r\n", "\n").replace("\r", "\n"):
        return kept, [
            "Some characters were removed from your cell, because a Python file cannot contain them."
        ]
    return kept, []


def _as_ipython_reads(source: str) -> list[str]:
    """Return a cell's lines after the changes that IPython makes before it searches for a magic.

    The lines have no indentation and no prompts, and no line is empty.
    """
    lines = (source.rstrip() + "\n").splitlines(keepends=True)
    for transform in TransformerManager().cleanup_transforms:
        lines = cast(Transform, transform)(lines)
    return lines


def _without_magic(source: str) -> tuple[str, list[str]]:
    magic = magic_of(source)
    if not magic:
        return source, []
    body = "".join(_as_ipython_reads(source)[1:])
    shown = magic.split()[0][:40]
    return f"# {shown} has no effect here\n{body}".rstrip("\n"), [
        (f"{shown} in the first line of your cell was removed, because the cell has to contain Python.")
    ]


def _with_magic(source: str, first_line: str) -> tuple[str, list[str]]:
    """Return the source with `first_line` as its first line."""
    magic = magic_of(source)
    body = "".join(_as_ipython_reads(source)[1:]) if magic else source
    kept = f"{first_line}\n{body.strip(chr(10))}"
    if " ".join(magic.split()) == " ".join(first_line.split()):
        return kept, []
    return kept, [
        f"The first line of your cell was wrong, so it was replaced by the right line: {first_line}"
    ]


def _without_markers(source: str) -> tuple[str, list[str]]:
    """Put brackets around each nbval marker; nbval then ignores the marker."""
    lines = source.splitlines(keepends=True)
    found = [_marker(line) for line in lines]
    if not any(found):
        return source, []
    kept = [
        line.replace(mark, f"({mark})") if mark else line for line, mark in zip(lines, found, strict=True)
    ]
    names = ", ".join(sorted({mark for mark in found if mark}))
    return "".join(kept), [f"A comment with the text {names} has no effect on the grade."]


def _marker(line: str) -> str:
    """Return the marker that nbval would find in this line."""
    if not (comment := line.strip()).startswith("#"):
        return ""
    word = comment.lstrip("#").strip()
    return word if word in MARKERS else ""
