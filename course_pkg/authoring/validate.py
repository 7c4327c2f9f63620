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
A_CORE = 2  # notebooks: most of their time they wait, for nodes to start and for answers


def workers_here(notebooks: int) -> int:
    """Return how many notebooks to run at once on this machine."""
    return max(1, min(notebooks, A_CORE * (os.cpu_count() or 1)))


def validate(
    notebooks: Sequence[Path], *, workers: int | None = None, timeout: float = 900.0, compare: bool = True
) -> subprocess.CompletedProcess[str]:
    """Run nbval over `notebooks`, each on a master of its own, `workers` at once, within `timeout` s.

    A notebook stays on one worker (`--dist loadfile`): nbval cannot share a kernel between two; those with
    the most cells begin. Each runs as a copy in a folder of its own, for nbval gives the kernel the
    notebook's folder to work in. Without `compare`, a notebook only has to run to its end: what it shows is
    not held against what is stored.
    """
    with surroundings() as (folder, environment):
        copies = [_copied(path, folder) for path in notebooks]
        return subprocess.run(
            command(copies, workers=workers or workers_here(len(copies)), compare=compare),
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=timeout,
            check=False,
        )


def _copied(notebook: Path, folder: Path) -> Path:
    own = folder / notebook.stem
    own.mkdir()
    return Path(shutil.copy(notebook, own))


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
        *("-c", os.devnull, "--rootdir", str(notebooks[0].parents[1]), "--nbval-cell-timeout", str(CELL)),
        *("--nbval-sanitize-with", str(SANITIZE)),
        *map(str, notebooks),
    ]
