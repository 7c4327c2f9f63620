"""Makes small installations of the course for tests, with the Python environment of the checkout."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

from course_pkg.installed import RECORD
from course_pkg.setup import PACKAGE_PARTS, Places

ROOT = Path(__file__).parents[2]


def make_version(prefix: Path) -> Path:
    """Install a version of the course with two chapters, and return the version's folder.

    The catkin workspace of this version is a link to the workspace of the checkout, so tests need no build.
    """
    version, built = prefix / "versions" / "1", Places.of().cache
    checkout = version / "course"
    (checkout / "notebooks").mkdir(parents=True)
    for number in ("05", "06"):
        (checkout / "notebooks" / f"{number}.ipynb").write_text(f"chapter {number}")
    for name in ("course", *PACKAGE_PARTS):
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, checkout / name, ignore=shutil.ignore_patterns("__pycache__"))
        elif source.exists():
            shutil.copy2(source, checkout / name)
    (version / "env").symlink_to(built)
    (version / RECORD).write_text(json.dumps({}))
    return version


def asked(version: Path, program: str, **variables: str) -> str:
    """Run Python code with the package of one version of the course, and return the output."""
    command = [Places.of().python, "-c", program]
    environment = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "PYTHONPATH": str(version / "course")}
    done = subprocess.run(
        command, env={**environment, **variables}, capture_output=True, text=True, check=True, cwd=version
    )
    return done.stdout + done.stderr
