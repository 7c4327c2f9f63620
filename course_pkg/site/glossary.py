"""The glossary: the terms of the course, each with a link to the section that first explains it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from markupsafe import Markup

from course_pkg.authoring.cells import Notebook
from course_pkg.site.chapters import Chapter
from course_pkg.site.pages import Page, Renderer
from course_pkg.site.search_index import Heading, Section

HERE = Path(__file__).parent


class Entry(NamedTuple):
    """A term, its meaning, its anchor, and a link to the section that explains it.

    `page` is the address of the section that explains the term. `where` is the name of the section's chapter.
    `page` and `where` are empty if no chapter explains the term.
    """

    term: str
    meaning: str
    anchor: str
    page: str
    where: str


class Glossary:
    """All entries, in alphabetical order."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self.entries = sorted(entries, key=lambda entry: entry.term.lower())

    @classmethod
    def of(cls, texts: Sequence[tuple[Chapter, Notebook, Sequence[Heading]]]) -> Glossary:
        """Return the glossary; its links lead to the chapters in `texts`."""
        written: dict[str, str] = json.loads((HERE / "glossary.json").read_text("utf-8"))
        return cls([_entry(term, meaning, texts) for term, meaning in written.items()])

    def page(self, renderer: Renderer) -> Page:
        """Return the glossary as a page."""
        return Page("glossary.html", "glossary", "Glossary", "The terms of the course.", self.text(renderer))

    def text(self, renderer: Renderer) -> Markup:
        """Return the glossary as HTML, without the frame of a page."""
        return renderer.part("glossary.html.j2", entries=self.entries)

    def sections(self) -> Iterator[Section]:
        """Yield the glossary's entries as sections for the search index."""
        for entry in self.entries:
            yield Section("Glossary", f"glossary.html#{entry.anchor}", entry.term, entry.meaning)


def _entry(term: str, meaning: str, texts: Sequence[tuple[Chapter, Notebook, Sequence[Heading]]]) -> Entry:
    anchor = "term-" + re.sub(r"[^a-z0-9]+", "-", term.lower()).strip("-")
    for chapter, notebook, headings in texts:
        if heading := _explained(term, notebook, headings):
            return Entry(term, meaning, anchor, f"{chapter.page}#{heading[1]}", f"Chapter {chapter.number}")
    return Entry(term, meaning, anchor, "", "")


def _explained(term: str, notebook: Notebook, headings: Sequence[Heading]) -> Heading | None:
    """Return the heading of the first section with the term in bold or italics, or None."""
    coming = iter(headings)
    current = None
    marked = re.compile(rf"\*{{1,2}}{re.escape(term)}s?\*{{1,2}}", re.IGNORECASE)
    for cell in notebook["cells"]:
        if cell["cell_type"] != "markdown":
            continue
        for line in cell["source"].split("\n"):
            if re.match(r"#{1,4} ", line):
                current = next(coming, current)
            if marked.search(line):
                return current
    return None
