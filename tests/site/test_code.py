"""Tests of the conversion of code to HTML with syntax colours."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.site.markup.code import Highlighter
from course_pkg.site.markup.prose import words


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_colours_do_not_change_the_text(path: Path) -> None:
    """The coloured HTML without its tags is equal to the source of the cell."""
    highlight = Highlighter()
    for cell in code_cells(read(path)):
        assert words(highlight.cell(cell["source"])) == cell["source"].strip("\n")


def test_a_magic_selects_the_language_of_a_cell() -> None:
    """The file name or the shell in a magic selects the language for the syntax colours."""
    highlight = Highlighter()
    assert "<i class=k>def</i>" in highlight.cell("%%writefile a.py\ndef f(): ...")
    assert "<i class=k>if</i>" in highlight.cell("%%bash\nif true; then echo; fi")
    assert "<i class=k>&lt;node/&gt;</i>" in highlight.cell("%%writefile a.launch\n<node/>")
    assert highlight.cell("%%writefile notes.xyz\ndef f(): ...").endswith("</i>def f(): ...")


def test_html_in_code_is_shown_as_text() -> None:
    """Tags in code are escaped."""
    assert "<script" not in Highlighter().cell("'<script>' & \"</pre>\"")
