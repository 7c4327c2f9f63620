"""Tests of each notebook: nbval runs the notebook in a kernel with its own master."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.validate import validate

ROOT = Path(__file__).parents[2]
NAMES = sorted(path.name for path in (ROOT / "solutions").glob("*.ipynb"))


@pytest.mark.timeout(620)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("folder", ["solutions", pytest.param("notebooks", marks=pytest.mark.when_changed)])
def test_a_notebook_runs_to_its_end(folder: str, name: str) -> None:
    """When a solution runs, its outputs are equal to the stored outputs.

    In a student's notebook, only cells with the tag raises-exception fail.
    """
    result = validate([ROOT / folder / name], workers=1, timeout=600, compare=folder == "solutions")
    assert result.returncode == 0, result.stdout[-6000:]
