"""Tests of the files that notebooks write, and of the stored check reports."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells, not_passed
from course_pkg.authoring.notebook_store import read

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_no_file_has_the_name_of_one_of_the_course(path: Path) -> None:
    """A notebook writes no file with the name of a node, a launch file or a service type of the course.

    Files below src/ are exceptions, because they belong to a student's package.
    """
    written = {
        Path(found).name
        for cell in code_cells(read(path))
        for found in re.findall(r"^%%writefile (?:-a )?(\S+)", cell["source"], re.MULTILINE)
        if not found.startswith("src/")
    }
    nodes = {module.stem for module in (ROOT / "course_pkg" / "nodes").glob("*.py")}
    files = {file.name for folder in ("launch", "srv") for file in (ROOT / folder).iterdir()}
    assert not written & (nodes | files)


@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_each_stored_check_has_passed(path: Path) -> None:
    """A stored report begins with the id of the part and "passed"."""
    assert not_passed(read(path)) == {}
