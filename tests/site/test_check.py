"""Tests of the faults that `course site --check` reports."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.site.check import faults

GOOD = (
    '<h1 id="a b">A</h1><a href="#a%20b">up</a><a href="two.html#x">on</a><a href="https://e.org/#x">out</a>'
)


def page(folder: Path, html: str) -> list[str]:
    """Write a page with the given HTML text, and a second, correct page; return the faults of both pages."""
    (folder / "one.html").write_text(f"<html><body>{html}")
    (folder / "two.html").write_text('<p id="x">x</p>')
    return faults(folder)


@pytest.mark.parametrize(
    ("html", "fault"),
    [
        ('<a href="three.html">x</a>', "one.html: the file of the link three.html does not exist"),
        ('<a href="two.html#y">x</a>', "one.html: the page of the link two.html#y has no such id"),
        ('<a href="#y">x</a>', "one.html: the page of the link #y has no such id"),
        ('<a href="">x</a>', "one.html: a link has no address"),
        ('<link rel="stylesheet" href="a.css">', "one.html: the file of the link a.css does not exist"),
        ('<script src="a.js"></script>', "one.html: the file of the link a.js does not exist"),
        ('<p id="q"></p><p id="q"></p>', "one.html: the id 'q' is used 2 times"),
        (
            '<img src="data:image/png;base64,AA">',
            "one.html: a picture has no description: data:image/png;base64,AA",
        ),
        ('<img src="data:," alt=" ">', "one.html: a picture has no description: data:,"),
        ("<svg></svg>", "one.html: a drawing has no description"),
        ('<div data-panel="oven"></div>', "one.html: there is no front end for the panel 'oven'"),
        (
            '<img src="//e.org/a.png" alt="a">',
            "one.html: the page would load //e.org/a.png from another computer",
        ),
        ("<p onclick='f()'>x</p>", "one.html: the page contains a script: <p onclick>"),
        ("<script>f()</script>", "one.html: the page contains a script: <script>"),
        (
            "<p>so $x^2$ it is</p>",
            "one.html: $x^2$ looks like a formula, but is not rendered",
        ),
    ],
)
def test_a_fault_is_found(tmp_path: Path, html: str, fault: str) -> None:
    """`faults` returns one fault, which begins with the name of the page."""
    assert page(tmp_path, html) == [fault]


@pytest.mark.parametrize(
    "html",
    [
        GOOD,
        '<img src="data:," alt="a chair"><svg aria-hidden="true"></svg><svg aria-labelledby="t"></svg>',
        '<div data-panel="graph"></div><script type="text/plain">AA</script>',
        "<p>It costs $5, and then $7.</p><pre>$x and $y$</pre><code>$?</code>",
    ],
)
def test_a_correct_page_has_no_fault(tmp_path: Path, html: str) -> None:
    """A correct page has no fault, even with prices and shell variables."""
    assert page(tmp_path, html) == []
