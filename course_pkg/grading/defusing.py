"""A student's source without what changes how it is run: no marker of nbval's, no magic over the cell.

nbval takes a comment such as `# NBVAL_SKIP` on any line for an order, and IPython gives a whole cell away to
the magic on its first line. Both would decide whether an answer is looked at at all.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, cast

from IPython.core.inputtransformer2 import TransformerManager

MARKERS = (  # nbval 0.11, plugin.py, comment_markers
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
    """A source that is safe to place, and what was done to it, in words for the student."""

    source: str
    notes: tuple[str, ...] = ()


def defuse(source: str, first_line: str = "") -> Defused:
    """Return the source of an answer under `first_line`, the magic that the reference has over it, if any."""
    kept, notes = _readable(source)
    kept, about_magic = _with_magic(kept, first_line) if first_line else _without_magic(kept)
    kept, about_markers = _without_markers(kept)
    return Defused(kept, (*notes, *about_magic, *about_markers))


def magic_of(source: str) -> str:
    """Return the line of the magic that IPython would give the whole cell to, or an empty text."""
    return first[0].strip() if (first := _as_ipython_reads(source)) and first[0].startswith("%%") else ""


def _readable(source: str) -> tuple[str, list[str]]:
    """Return a text that Python and UTF-8 can hold."""
    kept = source.replace("\r\n", "\n").replace("\r", "\n").replace("\x00", "")
    kept = kept.encode("utf-8", "replace").decode("utf-8")  # half of a pair becomes a question mark
    if kept != source.replace("\r\n", "\n").replace("\r", "\n"):
        return kept, ["Characters that no Python file can hold were taken out of your cell."]
    return kept, []


def _as_ipython_reads(source: str) -> list[str]:
    """Return the lines that IPython looks for a magic in: blank lines, indentation and prompts are gone."""
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
        f"{shown} over your cell was taken out: the cell has to be Python, as it was handed out."
    ]


def _with_magic(source: str, first_line: str) -> tuple[str, list[str]]:
    """Return the source below `first_line`, whatever stood there."""
    magic = magic_of(source)
    body = "".join(_as_ipython_reads(source)[1:]) if magic else source
    kept = f"{first_line}\n{body.strip(chr(10))}"
    if " ".join(magic.split()) == " ".join(first_line.split()):
        return kept, []
    return kept, [f"The first line of the cell was put back: it has to be {first_line}"]


def _without_markers(source: str) -> tuple[str, list[str]]:
    """Put each marker in brackets: lines are those of str.splitlines, as nbval takes them."""
    lines = source.splitlines(keepends=True)
    found = [_marker(line) for line in lines]
    if not any(found):
        return source, []
    kept = [
        line.replace(mark, f"({mark})") if mark else line for line, mark in zip(lines, found, strict=True)
    ]
    names = ", ".join(sorted({mark for mark in found if mark}))
    return "".join(kept), [f"{names} in a comment has no effect in grading."]


def _marker(line: str) -> str:
    """Return the marker that nbval would find in the line."""
    if not (comment := line.strip()).startswith("#"):
        return ""
    word = comment.lstrip("#").strip()
    return word if word in MARKERS else ""
