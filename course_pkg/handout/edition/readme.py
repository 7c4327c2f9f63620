"""The students' README: the course's README without the parts for instructors and maintainers."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

INSTRUCTORS = re.compile(r"<!-- instructors -->\n.*?<!-- end -->\n\n?", re.DOTALL)
PATHS = re.compile(r"^## Three paths\n.*?(?=^## )", re.DOTALL | re.MULTILINE)
CHAPTER = re.compile(r"\| (\d\d) \| \[")  # The pattern matches a row of the table of chapters.
COMMAND = re.compile(r"\| `\./course ([a-z-]+)")  # The pattern matches a row of the table of commands.
LINK = re.compile(r"\[([^\]\n]+)\]\((?:\./)?(?:notebooks/)?(\d\d)_\w+\.ipynb(?:#[^)\s]*)?\)")
NOTE = "This is the students' edition: it contains no solutions.{}"
SOME = " This edition has {}."


def student_readme(text: str, released: Sequence[str], known: Sequence[str], hidden: Collection[str]) -> str:
    """Return the students' README, made from the course's README `text`.

    `known` contains all chapters of the course. The README lists only the chapters in `released`, and no
    commands in `hidden`. Everything between the comments `<!-- instructors -->` and `<!-- end -->` is
    removed.
    """
    kept = INSTRUCTORS.sub("", text)
    some = tuple(released) != tuple(known)
    if some:
        kept = PATHS.sub("", kept)
    lines = [line for line in kept.split("\n") if not _is_hidden(line, released, hidden)]
    note = NOTE.format(SOME.format(named(released)) if some else "")
    place = next((number for number, line in enumerate(lines) if line.startswith("## ")), len(lines))
    return unlinked("\n".join([*lines[:place], note, "", *lines[place:]]), released).rstrip() + "\n"


def unlinked(text: str, released: Collection[str]) -> str:
    """Return Markdown without links to the notebooks of unreleased chapters.

    Only the text of such a link remains.
    """
    return LINK.sub(lambda link: link[0] if link[2] in released else link[1], text)


def named(chapters: Sequence[str]) -> str:
    """Return the chapters as text, such as "chapter 05" or "chapters 05, 06 and 07"."""
    *first, last = chapters
    return f"chapters {', '.join(first)} and {last}" if first else f"chapter {last}"


def _is_hidden(line: str, released: Collection[str], hidden: Collection[str]) -> bool:
    chapter, command = CHAPTER.match(line), COMMAND.match(line)
    return bool((chapter and chapter[1] not in released) or (command and command[1] in hidden))
