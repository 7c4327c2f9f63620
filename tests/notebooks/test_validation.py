"""The solutions do what they say: nbval runs each from the top and compares every output."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from course_pkg.authoring.execute import surroundings

ROOT = Path(__file__).parents[2]


def nbval(notebook: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run nbval on one notebook, in a kernel on a master of its own."""
    command = [sys.executable, "-m", "pytest", "--nbval-cell-timeout=60", "-p", "no:cacheprovider", "-q", *options]
    sanitise = ["--nbval-sanitize-with", str(ROOT / "tests" / "notebooks" / "sanitise.cfg")]
    with surroundings() as (_, environment):
        return subprocess.run(
            [*command, *sanitise, "-o", "addopts=", "-W", "default", str(notebook)],
            cwd=ROOT, env=environment, capture_output=True, text=True, timeout=300,
        )  # fmt: skip


@pytest.mark.timeout(320)
@pytest.mark.parametrize("path", sorted((ROOT / "solutions").glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_solution_shows_what_it_stored(path: Path) -> None:
    """Running a solution again gives the outputs that are stored in it."""
    result = nbval(path, "--nbval")
    assert result.returncode == 0, result.stdout[-6000:]


@pytest.mark.timeout(320)
@pytest.mark.parametrize("path", sorted((ROOT / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_run_all_reaches_the_end_with_nothing_answered(path: Path) -> None:
    """A student's notebook as it is handed out runs to its last cell, and no cell fails that is not meant to."""
    result = nbval(path, "--nbval-lax")
    assert result.returncode == 0, result.stdout[-6000:]
