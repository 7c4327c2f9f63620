"""Tests of the glossary and of the texts that the search uses."""

from __future__ import annotations

import json
from pathlib import Path

import course_pkg.site.glossary as module
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.site.chapters import chapter_of
from course_pkg.site.exporter import Exporter
from course_pkg.site.glossary import Glossary
from course_pkg.site.search_index import plain, script, sections
from tests.authoring.books import book, code, text

WRITTEN: dict[str, str] = json.loads((Path(module.__file__).parent / "glossary.json").read_text("utf-8"))


def test_most_terms_link_to_their_explanation() -> None:
    """At least 80 % of the terms have a link to the section that explains the term."""
    exporter, texts = Exporter(), []
    for path in NotebookStore().solutions():
        notebook = read(path)
        texts.append(
            (chapter_of(path.stem, notebook), notebook, exporter.body(notebook, folder=path.parent).headings)
        )
    found = {entry.term: entry.page for entry in Glossary.of(texts).entries}
    assert found["master"] == "00_start_the_graph.html#1-a-master-and-a-first-node"
    assert len([page for page in found.values() if page]) >= 0.8 * len(found)


def test_every_entry_is_a_sentence() -> None:
    """Each glossary entry ends with a full stop, and the entries are in alphabetical order."""
    assert [term for term, meaning in WRITTEN.items() if not meaning.endswith(".")] == []
    assert list(WRITTEN) == sorted(WRITTEN, key=str.lower)


def test_no_two_entries_share_an_anchor() -> None:
    """All entries of the glossary have different anchors."""
    anchors = [entry.anchor for entry in Glossary.of([]).entries]
    assert len(set(anchors)) == len(anchors)


def test_each_section_has_its_anchor_and_its_text() -> None:
    """The search text of a section contains its prose and its code. A # in code does not begin a section."""
    notebook = book(
        text("# Title\n\nThe lead.", "t1"),
        text("## One\n\n```\n## no heading\n```\nA **word**.", "t2"),
        code("# a comment\nwait()"),
        text("## Two\n\nMore.", "t3"),
    )
    found = list(sections("05 Title", "05.html", notebook, Exporter().body(notebook).headings))
    assert [(each.url, each.title) for each in found] == [
        ("05.html#title", "Title"),
        ("05.html#one", "One"),
        ("05.html#two", "Two"),
    ]
    assert "A word ." in found[1].text
    assert "wait()" in found[1].text


def test_marks_of_markdown_are_removed() -> None:
    """The search texts contain the texts of links and table cells, but no Markdown characters."""
    assert (
        plain("See [there](a.html), `code`, **bold**\n| a | b |\n|---|---|") == "See there, code , bold a b"
    )


def test_the_texts_are_a_script() -> None:
    """The search texts are in a script, because a page in a local folder cannot fetch a file."""
    assert script([]) == "courseTexts([]);\n"
