"""The notebooks do what they say: nbval runs each from the top, in a kernel on a master of its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.validate import validate

ROOT = Path(__file__).parents[2]


@pytest.mark.timeout(620)
@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_solution_shows_what_it_stored_and_its_notebook_runs_to_the_end(path: Path) -> None:
    """A solution gives its stored outputs again; a student's notebook runs to its end as it is handed out.

    No cell fails that is not meant to. One after the other: a chapter may write to one place in /tmp.
    """
    for notebook, compare in ((path, True), (ROOT / "notebooks" / path.name, False)):
        result = validate([notebook], workers=1, timeout=300, compare=compare)
        assert result.returncode == 0, result.stdout[-6000:]
