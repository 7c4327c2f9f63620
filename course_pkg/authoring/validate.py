"""Validate stored notebooks: nbval runs each and compares what it shows with what is stored."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from course_pkg.authoring.execute import CELL, surroundings

SANITIZE = Path(__file__).with_name("nbval_sanitize.cfg")


def validate(
    notebooks: Sequence[Path], *, workers: int = 2, timeout: float = 900.0, compare: bool = True
) -> subprocess.CompletedProcess[str]:
    """Run nbval over `notebooks`, each on a master of its own, `workers` at once, within `timeout` s.

    A notebook stays on one worker (`--dist loadfile`): nbval cannot share a kernel between two. It runs as a
    copy, for nbval gives the kernel the notebook's own folder to work in. Without `compare`, a notebook
    only has to run to its end: what it shows is not held against what is stored.
    """
    with surroundings() as (folder, environment):
        copies = [shutil.copy(path, folder) for path in notebooks]
        return subprocess.run(
            command([Path(copy) for copy in copies], workers=workers, compare=compare),
            env=environment,
            capture_output=True,
            text=True,
            timeout=timeout,
            check=False,
        )


def command(notebooks: Sequence[Path], *, workers: int, compare: bool = True) -> list[str]:
    """Return the command; no configuration of the repository's own tests takes part in it."""
    parallel = ["-n", str(workers), "--dist", "loadfile"] if workers > 1 else ["-p", "no:xdist"]
    return [
        *(
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "--nbval" if compare else "--nbval-lax",
            "-p",
            "no:cacheprovider",
            *parallel,
        ),
        *("-c", os.devnull, "--rootdir", str(notebooks[0].parent), "--nbval-cell-timeout", str(CELL)),
        *("--nbval-sanitize-with", str(SANITIZE)),
        *map(str, notebooks),
    ]
