"""Code with its colours."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.site.code import Highlighter
from course_pkg.site.prose import words


@pytest.mark.parametrize("path", Shelf().solutions(), ids=lambda path: path.stem)
def test_colours_change_no_letter(path: Path) -> None:
    """What is read, searched and copied is the cell, of every cell of the course."""
    highlight = Highlighter()
    for cell in code_cells(read(path)):
        assert words(highlight.cell(cell["source"])) == cell["source"].strip("\n")


def test_a_magic_says_what_the_rest_is() -> None:
    """A file's name and a shell's name choose the colours; a name that nobody knows chooses none."""
    highlight = Highlighter()
    assert "<i class=k>def</i>" in highlight.cell("%%writefile a.py\ndef f(): ...")
    assert "<i class=k>if</i>" in highlight.cell("%%bash\nif true; then echo; fi")
    assert "<i class=k>&lt;node/&gt;</i>" in highlight.cell("%%writefile a.launch\n<node/>")
    assert highlight.cell("%%writefile notes.xyz\ndef f(): ...").endswith("</i>def f(): ...")


def test_what_looks_like_markup_is_text() -> None:
    """Code can hold anything that HTML would take for its own."""
    assert "<script" not in Highlighter().cell("'<script>' & \"</pre>\"")
