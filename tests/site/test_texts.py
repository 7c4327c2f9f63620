"""What the search looks through."""

from __future__ import annotations

from course_pkg.site.exporter import Exporter
from course_pkg.site.texts import plain, script, sections
from tests.authoring.books import book, code, text


def test_a_section_is_found_where_it_stands() -> None:
    """Each with its anchor, its prose and its code; a # in code begins none."""
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


def test_marks_are_no_words() -> None:
    """Links leave their text, tables their cells."""
    assert (
        plain("See [there](a.html), `code`, **bold**\n| a | b |\n|---|---|") == "See there, code , bold a b"
    )


def test_the_texts_are_a_script() -> None:
    """A page in a folder cannot fetch, but it can load a script."""
    assert script([]) == "courseTexts([]);\n"
