"""Builds the files that every page loads from the npm registry: `python -m course_pkg.site.bundling`.

Node is needed only to change them: the built files are in `assets/`, and a test builds them again.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from course_pkg.errors import SiteError

HERE = Path(__file__).parent
BUNDLE = HERE / "bundle"
ASSETS = HERE / "assets"
BUILT = ("early.js", "fonts.css", "site.js", "LICENSES.txt")
AXE = "axe.min.js"  # no page loads it: the tests look the pages over with it
TESTS = Path(__file__).parents[2] / "tests" / "site"
TIMEOUT = 300  # s for the registry


def build(target: Path, names: Sequence[str] = (*BUILT, AXE)) -> list[Path]:
    """Build the files of these names into `target`, and return them.

    It works in a folder of its own: node_modules inside the package would be walked by rosrun. Raises
    SiteError where npm is missing or fails.
    """
    with tempfile.TemporaryDirectory(prefix="course-bundle-") as folder:
        work = Path(shutil.copytree(BUNDLE, Path(folder) / "bundle"))
        _npm(work, "ci", "--no-audit", "--no-fund", "--loglevel=error")
        _npm(work, "run", "build", "--loglevel=error")
        return [Path(shutil.copy(work / "out" / name, target / name)) for name in names]


def _npm(folder: Path, *words: str) -> None:
    npm = shutil.which("npm")
    if not npm:
        raise SiteError("npm is not on this machine; it comes with Node 20 and newer.")
    try:
        result = subprocess.run(
            [npm, *words], cwd=folder, capture_output=True, text=True, timeout=TIMEOUT, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise SiteError(
            f"npm {words[0]} did not end within {TIMEOUT} s. Can its registry be reached?"
        ) from error
    if result.returncode:
        raise SiteError(f"npm {words[0]} failed:\n{result.stderr or result.stdout}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="course-built-") as fresh:
        for path in build(Path(fresh)):
            place = TESTS if path.name == AXE else ASSETS
            sys.stdout.write(f"{shutil.copy(path, place)}\n")
