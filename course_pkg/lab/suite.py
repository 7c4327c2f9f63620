"""`course test`: lint, types, spelling and the tests, each shown with its outcome."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.provision import Places

CHECKS = {
    "lint": ["ruff", "check", "--quiet", "."],
    "format": ["ruff", "format", "--quiet", "--check", "."],
    "types": ["mypy"],
    "spelling": ["codespell"],
}

TESTS_FAILED = 1  # an exit status of pytest's
# Nodes, browsers and builds side by side can starve each other on a small machine. What then fails by itself,
# too, is wrong; what passes is named by the first run, and is worth a look.
AGAIN = "course: the tests that failed are tried again, one at a time\n"


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
    workers = (os.cpu_count() or 2) + 1  # one goes through the notebooks, which mostly wait
    spread = [] if arguments else ["-n", str(workers), "--dist", "loadgroup", "--no-loadscope-reorder"]
    status = _tests(places, *spread, *arguments)
    if status == TESTS_FAILED and not arguments:
        sys.stderr.write(AGAIN)
        status = _tests(places, "--last-failed", "--last-failed-no-failures", "none", "--maxfail", "3")
    if failed:
        sys.stderr.write(f"course: failed besides the tests: {', '.join(failed)}\n")
    return status or bool(failed)


def _tests(places: Places, *arguments: str) -> int:
    environ = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
    command: list[str | Path] = [places.python, "-m", "pytest", *arguments]
    return subprocess.run(command, cwd=places.checkout, env=environ, check=False).returncode


def _passes(places: Places, name: str, command: Sequence[str]) -> bool:
    started = time.monotonic()
    result = subprocess.run(
        [places.venv / "bin" / command[0], *command[1:]], cwd=places.checkout, check=False, stdout=sys.stderr
    )
    outcome = "done" if result.returncode == 0 else "failed"
    sys.stderr.write(f"{name}: {outcome} ({time.monotonic() - started:.1f} s)\n")
    return result.returncode == 0
