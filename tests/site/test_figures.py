"""Tests of the figures that Markdown cells contain."""

from __future__ import annotations

import re
from base64 import b64encode
from pathlib import Path

import pytest

from course_pkg.errors import SiteError
from course_pkg.setup import Places
from course_pkg.site.build import Settings, write_site
from course_pkg.site.exporter import Body, Exporter
from course_pkg.site.markup.figures import figure
from tests.authoring.books import book, text
from tests.site.notebook_stores import runs, store

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100" aria-labelledby="t">'
    '<title id="t">A title</title><defs><marker id="tip"><path d="M0 0"/></marker></defs>'
    '<path d="M0 0 8 8" marker-end="url(#tip)"/><text>devel &amp; src</text></svg>'
)


def page(folder: Path, *sources: str, prefix: str = "") -> Body:
    """Return the body of a page that has one Markdown cell for each of the given texts."""
    return Exporter().body(book(*(text(source, f"t{n}") for n, source in enumerate(sources))), prefix, folder)


def test_a_drawing_is_a_part_of_the_page(tmp_path: Path) -> None:
    """An SVG drawing becomes part of the page, with the description from the Markdown and unique ids."""
    (tmp_path / "a b.svg").write_text(DRAWING)
    html = page(tmp_path, '![A "box" & more](a%20b.svg)', "![Again](a%20b.svg)", prefix="c07-").html
    assert html.count('<figure class="wide"><svg ') == 2
    assert 'aria-label="A &quot;box&quot; &amp; more"' in html
    assert "<text>devel &amp; src</text>" in html
    assert "A title" not in html
    assert re.findall(r'id="([^"]*)"', html) == ["c07-f1-tip", "c07-f2-tip"]
    assert re.findall(r"url\(#([^)]*)\)", html) == ["c07-f1-tip", "c07-f2-tip"]


def test_a_page_contains_the_data_of_a_picture(tmp_path: Path) -> None:
    """The address of a picture contains the picture's data, because a page loads no other files."""
    content = b"\x89PNG"
    (tmp_path / "chair.png").write_bytes(content)
    html = page(tmp_path, "Look: ![a chair](chair.png)").html
    assert f'<img src="data:image/png;base64,{b64encode(content).decode()}" alt="a chair">' in html


@pytest.mark.parametrize(
    ("markdown", "problem"),
    [
        ("![x](../figures/none.svg)", "There is no figure ../figures/none.svg"),
        ("![x](https://example.org/x.png)", "There is no figure https://example.org/x.png"),
        ("![](drawing.svg)", "The figure drawing.svg has no description"),
        ("![x](notes.txt)", "notes.txt has the wrong format"),
        ("![x](broken.svg)", "broken.svg cannot be read"),
        ("![x](script.svg)", "script.svg has a <script>"),
        ("![x](handler.svg)", 'handler.svg has onload="f'),
        ("![x](link.svg)", 'link.svg has .*href="//x"'),
    ],
)
def test_a_figure_that_a_page_cannot_show_is_refused(tmp_path: Path, markdown: str, problem: str) -> None:
    """The error message for an invalid figure contains the figure and the problem."""
    namespace = 'xmlns="http://www.w3.org/2000/svg" xmlns:l="http://www.w3.org/1999/xlink"'
    files = {
        "drawing.svg": DRAWING,
        "notes.txt": "x",
        "broken.svg": "<svg>",
        "script.svg": f"<svg {namespace}><script/></svg>",
        "handler.svg": f'<svg {namespace} onload="f()"/>',
        "link.svg": f'<svg {namespace}><use l:href="//x"/></svg>',
    }
    for name, content in files.items():
        (tmp_path / name).write_text(content)
    with pytest.raises(SiteError, match=problem):
        page(tmp_path, markdown)


def test_a_site_with_a_missing_figure_is_not_written(tmp_path: Path) -> None:
    """The error message for a missing figure contains the folder of the notebook."""
    books = store(tmp_path, _00_try=[text("![x](../figures/none.svg)", "t")])
    with pytest.raises(SiteError, match=r"no figure \.\./figures/none\.svg in .*solutions"):
        write_site(Settings(tmp_path / "site", execute=False), books, runs(tmp_path / "cache"))


@pytest.mark.parametrize(
    "path", sorted((Places.of().checkout / "figures").iterdir()), ids=lambda path: path.name
)
def test_each_figure_of_the_course_can_be_shown(path: Path) -> None:
    """Each figure of the course can be shown, and each drawing has a white background."""
    assert figure(path.parent, path.name, "A figure", "f1-")
    if path.suffix == ".svg":
        assert re.search(r'<rect [^>]*fill="(#fff|#ffffff|white)"', path.read_text("utf-8"))
