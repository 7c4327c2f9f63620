"""The notebooks do what they say: nbval runs each from the top, in a kernel on a master of its own."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from course_pkg.authoring.validate import validate

ROOT = Path(__file__).parents[2]


@pytest.mark.timeout(400)
@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_solution_shows_what_it_stored_and_its_notebook_runs_to_the_end(path: Path) -> None:
    """A solution gives its stored outputs again; a student's notebook runs to its end as it is handed out.

    No cell fails that is not meant to. Both at once: most of their time they wait.
    """
    handed_out = ROOT / "notebooks" / path.name
    with ThreadPoolExecutor() as pool:
        solution = pool.submit(validate, [path], workers=1, timeout=380)
        student = pool.submit(validate, [handed_out], workers=1, timeout=380, compare=False)
    assert solution.result().returncode == 0, solution.result().stdout[-6000:]
    assert student.result().returncode == 0, student.result().stdout[-6000:]
