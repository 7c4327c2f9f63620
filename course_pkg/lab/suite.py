"""`course test`: lint, types, spelling and the tests, each shown with its outcome."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence

from course_pkg.errors import SetupError
from course_pkg.provision import Places

CHECKS = {
    "lint": ["ruff", "check", "--quiet", "."],
    "format": ["ruff", "format", "--quiet", "--check", "."],
    "types": ["mypy"],
    "spelling": ["codespell"],
}


def run_suite(arguments: Sequence[str]) -> int:
    """Run every check of the repository, all of them even where one fails; return 0 if all is well.

    `arguments` go to pytest; where there are any, only pytest runs.
    """
    places = Places.of()
    if not (places.venv / "bin" / "ruff").exists():  # only conda's environment comes without
        lock = places.checkout / "course_pkg" / "provision" / "locks" / "test.txt"
        raise SetupError(
            f"The tests need more than environment.yml has. Type: python -m pip install -r {lock}"
        )
    tools = {} if arguments else CHECKS
    failed = [name for name, command in tools.items() if not _passes(places, name, command)]
    environ = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
    spread = [] if arguments else ["-n", str(os.cpu_count() or 2), "--dist", "worksteal"]
    pytest = subprocess.run(
        [places.python, "-m", "pytest", *spread, *arguments], cwd=places.checkout, env=environ, check=False
    )
    if failed:
        sys.stderr.write(f"course: failed besides the tests: {', '.join(failed)}\n")
    return pytest.returncode or bool(failed)


def _passes(places: Places, name: str, command: Sequence[str]) -> bool:
    started = time.monotonic()
    result = subprocess.run(
        [places.venv / "bin" / command[0], *command[1:]], cwd=places.checkout, check=False, stdout=sys.stderr
    )
    outcome = "done" if result.returncode == 0 else "failed"
    sys.stderr.write(f"{name}: {outcome} ({time.monotonic() - started:.1f} s)\n")
    return result.returncode == 0
