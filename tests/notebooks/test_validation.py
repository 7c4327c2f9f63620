"""The notebooks do what they say: nbval runs each from the top, in a kernel on a master of its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.validate import validate

ROOT = Path(__file__).parents[2]


@pytest.mark.timeout(320)
@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_solution_shows_what_it_stored(path: Path) -> None:
    """Running a solution again gives the outputs that are stored in it."""
    result = validate([path], workers=1, timeout=300)
    assert result.returncode == 0, result.stdout[-6000:]


@pytest.mark.timeout(320)
@pytest.mark.parametrize("path", sorted((ROOT / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_run_all_reaches_the_end_with_nothing_answered(path: Path) -> None:
    """A student's notebook as it is handed out runs to its end; no cell fails that is not meant to."""
    result = validate([path], workers=1, timeout=300, compare=False)
    assert result.returncode == 0, result.stdout[-6000:]
