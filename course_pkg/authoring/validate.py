"""Validates stored notebooks: nbval runs each notebook, and compares its outputs with the stored outputs."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from course_pkg.authoring.execute import CELL_TIMEOUT, workers_here
from course_pkg.ros.process.supervised import temporary_folder

SANITIZE = Path(__file__).with_name("nbval_sanitize.cfg")
PLUGINS = (
    "course_pkg.authoring.private_notebook",
    "course_pkg.authoring.nbval_figures",
    "no:cacheprovider",
)


def validate(
    notebooks: Sequence[Path], *, workers: int | None = None, timeout: float = 900.0, compare: bool = True
) -> subprocess.CompletedProcess[str]:
    """Run nbval for the notebooks in parallel, and return the exit status and the output.

    `workers` is the number of processes.

    Each notebook has its own master. All cells of a notebook run on the same worker (`--dist loadfile`),
    because two workers cannot share a kernel of nbval. nbval starts the kernel in the folder of the notebook.
    Therefore, `validate` first copies each notebook into a separate, empty folder. If `compare` is False,
    nbval does not compare outputs; a notebook then passes if all cells run. Raises subprocess.TimeoutExpired
    after `timeout` s.
    """
    with temporary_folder("course-nbval-") as folder:
        copies = [_copied(path, folder) for path in notebooks]
        return subprocess.run(
            command(copies, workers=workers or workers_here(len(copies)), compare=compare),
            cwd=folder,
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
    """Return the command line that `validate` runs.

    The command does not use the configuration of the repository's own tests.
    """
    parallel = ["-n", str(workers), "--dist", "loadfile"] if workers > 1 else ["-p", "no:xdist"]
    return [
        *(sys.executable, "-m", "pytest", "-q", "--nbval" if compare else "--nbval-lax"),
        *(word for plugin in PLUGINS for word in ("-p", plugin)),
        *parallel,
        *("-c", os.devnull, "--rootdir", str(notebooks[0].parents[1])),
        *("--nbval-cell-timeout", str(CELL_TIMEOUT), "--nbval-sanitize-with", str(SANITIZE)),
        *map(str, notebooks),
    ]
