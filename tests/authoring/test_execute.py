"""A chapter is run from the top in a fresh kernel, and nbval finds what is stored to be what it shows."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from course_pkg.authoring import execute, validate
from course_pkg.errors import AuthoringError
from tests.authoring.books import book, check, code, exercise

SET_UP = 'from course_pkg import check, join\nfrom course_pkg.srv import geometry\nnode = join("chapter_05")'
SERVER = (
    "def handle_geometry(request):\n"
    "    area = request.width * request.length\n"
    "    return area, area * request.height\n\n\n"
    'node.serve("/getGeometry", geometry, handle_geometry)'
)


def solution(root: Path, *cells: dict[str, Any]) -> Path:
    """Write a solution of one chapter and return its path."""
    (root / "solutions").mkdir()
    path = root / "solutions" / "05_write_a_server.ipynb"
    path.write_text(json.dumps(book(*cells)))
    return path


def test_an_executed_solution_is_stable_and_valid(tmp_path: Path) -> None:
    """Run twice it is the same file, a check cell shows the pass, and nbval agrees."""
    path = solution(tmp_path, code(SET_UP, id="set-up"), exercise(source=SERVER), check())
    execute(["05"], tmp_path)
    first = path.read_text()
    assert "05.1 passed: 2 of 2 points" in first
    execute(["05"], tmp_path)
    assert path.read_text() == first
    outcome = validate([path], workers=1)
    assert outcome.returncode == 0, outcome.stdout


def test_a_cell_that_stops_the_run_is_named(tmp_path: Path) -> None:
    """With its id and the error, and the stored file is as it was."""
    path = solution(tmp_path, code("1 / 0", id="boom"))
    before = path.read_text()
    with pytest.raises(AuthoringError, match="cell boom stopped the run with ZeroDivisionError"):
        execute(["05"], tmp_path)
    assert path.read_text() == before
