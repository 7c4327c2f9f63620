"""The faults that `course site --check` finds."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.site.check import faults

GOOD = (
    '<h1 id="a b">A</h1><a href="#a%20b">up</a><a href="two.html#x">on</a><a href="https://e.org/#x">out</a>'
)


def page(folder: Path, html: str) -> list[str]:
    """Write a page with this text beside a good page, and return the faults."""
    (folder / "one.html").write_text(f"<html><body>{html}")
    (folder / "two.html").write_text('<p id="x">x</p>')
    return faults(folder)


@pytest.mark.parametrize(
    ("html", "fault"),
    [
        ('<a href="three.html">x</a>', "one.html: the link three.html leads to no file"),
        ('<a href="two.html#y">x</a>', "one.html: the link two.html#y leads to no place on that page"),
        ('<a href="#y">x</a>', "one.html: the link #y leads to no place on that page"),
        ('<a href="">x</a>', "one.html: a link leads nowhere"),
        ('<link rel="stylesheet" href="a.css">', "one.html: the link a.css leads to no file"),
        ('<script src="a.js"></script>', "one.html: the link a.js leads to no file"),
        ('<p id="q"></p><p id="q"></p>', "one.html: the id 'q' stands there 2 times"),
        (
            '<img src="data:image/png;base64,AA">',
            "one.html: a picture has no description: data:image/png;base64,AA",
        ),
        ('<img src="data:," alt=" ">', "one.html: a picture has no description: data:,"),
        ("<svg></svg>", "one.html: a drawing has no description"),
        ('<div data-panel="oven"></div>', "one.html: there is no front end for the panel 'oven'"),
        ('<img src="//e.org/a.png" alt="a">', "one.html: it would load //e.org/a.png from elsewhere"),
        ("<p onclick='f()'>x</p>", "one.html: a script stands in the page itself: <p onclick>"),
        ("<script>f()</script>", "one.html: a script stands in the page itself: <script>"),
        ("<p>so $x^2$ it is</p>", "one.html: $x^2$ looks like a formula, and stands where none is set"),
    ],
)
def test_a_fault_is_found(tmp_path: Path, html: str, fault: str) -> None:
    """Each fault is found alone, with its page."""
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
def test_what_is_right_is_let_be(tmp_path: Path, html: str) -> None:
    """Working links, figures with descriptions, prices and shell variables are no faults."""
    assert page(tmp_path, html) == []
