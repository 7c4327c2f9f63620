"""The glossary."""

from __future__ import annotations

import json
from pathlib import Path

import course_pkg.site.glossary as module
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.site.chapters import chapter_of
from course_pkg.site.exporter import Exporter
from course_pkg.site.glossary import Glossary

WRITTEN: dict[str, str] = json.loads((Path(module.__file__).parent / "glossary.json").read_text("utf-8"))


def test_most_words_lead_to_where_they_are_explained() -> None:
    """In the first section in which they are marked; some are only ever used."""
    exporter, texts = Exporter(), []
    for path in Shelf().solutions():
        notebook = read(path)
        texts.append((chapter_of(path.stem, notebook), notebook, exporter.body(notebook).headings))
    found = {entry.term: entry.page for entry in Glossary.of(texts).entries}
    assert found["master"] == "00_start_the_graph.html#1-a-master-and-a-first-node"
    assert len([page for page in found.values() if page]) >= 0.8 * len(found)


def test_every_entry_is_a_sentence() -> None:
    """And the file is in the order of the alphabet, so that a new word finds its place."""
    assert [term for term, meaning in WRITTEN.items() if not meaning.endswith(".")] == []
    assert list(WRITTEN) == sorted(WRITTEN, key=str.lower)


def test_no_two_entries_share_an_anchor() -> None:
    """A link leads to one of them."""
    anchors = [entry.anchor for entry in Glossary.of([]).entries]
    assert len(set(anchors)) == len(anchors)
