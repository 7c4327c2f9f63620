"""What a notebook writes stands in nobody's way: students work inside the package, where ROS looks."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.authoring.shelf import read

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_no_file_has_the_name_of_one_of_the_course(path: Path) -> None:
    """`roslaunch course_pkg X` refuses to choose between the course's X and a student's."""
    written = {
        Path(found).name
        for cell in code_cells(read(path))
        for found in re.findall(r"^%%writefile (?:-a )?(\S+)", cell["source"], re.MULTILINE)
    }
    nodes = {module.stem for module in (ROOT / "course_pkg" / "nodes").glob("*.py")}
    files = {file.name for folder in ("launch", "srv") for file in (ROOT / folder).iterdir()}
    assert not written & (nodes | files)
