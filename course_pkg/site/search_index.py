"""The texts for the search: every section of the course as plain text."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from course_pkg.authoring.cells import Notebook

HEADING = re.compile(r"^#{1,4} .*$", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
MARKS = re.compile(r"[`*|#>]+|^\s*-{3,}\s*$|:?-{3,}:?", re.MULTILINE)


Heading = tuple[int, str, str]  # The tuple contains the level, the anchor and the text.


class Section(NamedTuple):
    """A section of the course: its page, its address, its heading and its text."""

    page: str
    url: str
    title: str
    text: str


def sections(page: str, url: str, notebook: Notebook, headings: Sequence[Heading]) -> Iterator[Section]:
    """Yield the sections of a chapter, with their prose and code.

    `headings` contains the chapter's headings in order.
    """
    coming = iter(headings)
    anchor, title, words = "", page, ""
    for kind, text in _pieces(notebook):
        if kind == "heading" and (heading := next(coming, None)):
            if words.strip():
                yield Section(page, f"{url}#{anchor}", title, plain(words))
            _, anchor, title = heading
            words = ""
        else:
            words += f"\n{text}"
    if words.strip():
        yield Section(page, f"{url}#{anchor}", title, plain(words))


def script(found: Iterable[Section]) -> str:
    """Return the script that contains the texts for the search."""
    return f"courseTexts({json.dumps(list(found), ensure_ascii=False, separators=(',', ':'))});\n"


def plain(markdown: str) -> str:
    """Return Markdown or code as one line without Markdown syntax such as `#`, `*` and links."""
    return " ".join(MARKS.sub(" ", LINK.sub(r"\1", markdown)).split())


def _pieces(notebook: Notebook) -> Iterator[tuple[str, str]]:
    for cell in notebook["cells"]:
        if cell["cell_type"] != "markdown":
            yield "code", cell["source"]
            continue
        source, at = cell["source"], 0
        fences = [found.span() for found in FENCED.finditer(source)]
        for found in HEADING.finditer(source):
            if any(start <= found.start() < end for start, end in fences):
                continue
            yield "prose", source[at : found.start()]
            yield "heading", found[0]
            at = found.end()
        yield "prose", source[at:]
