"""Tests of the structure of every chapter."""

from __future__ import annotations

import json
import re
import statistics
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Cell

ROOT = Path(__file__).parents[2]
SOLUTIONS = sorted((ROOT / "solutions").glob("*.ipynb"))


@pytest.fixture(params=SOLUTIONS, ids=lambda path: path.stem)
def cells(request: pytest.FixtureRequest) -> list[Cell]:
    """Return the cells of a chapter."""
    notebook = json.loads(request.param.read_text("utf-8"))
    return [{**cell, "source": "".join(cell["source"])} for cell in notebook["cells"]]


def prose(cells: list[Cell]) -> str:
    """Return the text of all Markdown cells of a chapter."""
    return "\n\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")


def code(cells: list[Cell]) -> list[str]:
    """Return the source of each code cell of a chapter."""
    return [cell["source"] for cell in cells if cell["cell_type"] == "code"]


def test_chapter_begins_with_contents_requirements_and_time(cells: list[Cell]) -> None:
    """The first cell contains a title, the contents, the requirements and the time."""
    first = cells[0]["source"]
    assert first.startswith("# ")
    assert [word for word in ("**You will**", "**You need**", "**Time**") if word not in first] == []


def test_a_chapter_has_a_prediction_a_picture_and_three_exercises(cells: list[Cell]) -> None:
    """Each chapter has a prediction, a picture of the graph, and three checks."""
    source = "\n".join(code(cells))
    assert source.count("predict(") >= 1
    assert source.count("predict(") == source.count(".compare(")
    assert "GraphPanel()" in source
    assert source.count('check("') >= 3


def test_chapter_ends_with_a_summary_and_a_link(cells: list[Cell]) -> None:
    """The last section is a summary, and the last cell links to another chapter."""
    assert "## What you saw" in prose(cells)
    assert re.search(r"\]\(\d\d_\w+\.ipynb\)", cells[-1]["source"])


def test_links_lead_somewhere(cells: list[Cell]) -> None:
    """Each link to another chapter leads to an existing notebook."""
    targets = re.findall(r"\]\((\w+\.ipynb)\)", prose(cells))
    assert [target for target in targets if not (ROOT / "solutions" / target).exists()] == []


def test_code_is_short_and_prose_carries_it(cells: list[Cell]) -> None:
    """A cell has at most 15 lines, and a chapter has at least five words of prose for each line of code."""
    lengths = [len(cell["source"].splitlines()) for cell in cells if cell["cell_type"] == "code"]
    shown = [
        len(cell["source"].splitlines())
        for cell in cells
        if cell["cell_type"] == "code" and "exercise" not in cell["metadata"].get("course", {})
    ]
    assert max(shown) <= 15
    assert statistics.median(lengths) <= 4
    assert len(prose(cells).split()) >= 5 * sum(lengths)


def test_prose_is_plain_markdown(cells: list[Cell]) -> None:
    """The prose contains no HTML."""
    assert re.findall(r"</?[a-z]+[ >]", re.sub(r"`[^`]*`", "", prose(cells))) == []


def test_every_name_a_reader_needs_is_imported_where_it_is_taught(cells: list[Cell]) -> None:
    """A chapter contains no star import."""
    assert [source for source in code(cells) if "import *" in source] == []
