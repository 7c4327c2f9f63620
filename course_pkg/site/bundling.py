"""Builds the scripts, fonts and licences that every page loads: `python -m course_pkg.site.bundling`.

The build downloads packages from the npm registry and needs Node. The folder `assets/` contains the built
files. Therefore, only a maintainer who changes the scripts, fonts or licences needs Node. A test builds the
files again and compares them with the stored files.
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
AXE = "axe.min.js"  # No page loads this file. The tests use it to check the pages.
TESTS = Path(__file__).parents[2] / "tests" / "site"
TIMEOUT = 300  # One npm command may take up to this time in s, because it may download packages.


def build(target: Path, names: Sequence[str] = (*BUILT, AXE)) -> list[Path]:
    """Build the files `names` in the folder `target`, and return their paths.

    The build uses a temporary folder: rosrun would also search a node_modules folder inside the package.
    Raises SiteError if npm is missing or fails.
    """
    with tempfile.TemporaryDirectory(prefix="course-bundle-") as folder:
        work = Path(shutil.copytree(BUNDLE, Path(folder) / "bundle"))
        _npm(work, "ci", "--no-audit", "--no-fund", "--loglevel=error")
        _npm(work, "run", "build", "--loglevel=error")
        return [Path(shutil.copy(work / "out" / name, target / name)) for name in names]


def _npm(folder: Path, *words: str) -> None:
    npm = shutil.which("npm")
    if not npm:
        raise SiteError("This machine has no npm. Install Node 20 or newer, which includes npm.")
    try:
        result = subprocess.run(
            [npm, *words], cwd=folder, capture_output=True, text=True, timeout=TIMEOUT, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise SiteError(
            f"npm {words[0]} did not end within {TIMEOUT} s. Check that this machine can reach the "
            "npm registry."
        ) from error
    if result.returncode:
        raise SiteError(f"npm {words[0]} failed:\n{result.stderr or result.stdout}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="course-built-") as fresh:
        for path in build(Path(fresh)):
            place = TESTS if path.name == AXE else ASSETS
            sys.stdout.write(f"{shutil.copy(path, place)}\n")
