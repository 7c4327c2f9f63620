"""Runs a command in a copy of the course, as on an autograder without namespaces.

The command sees the copy at the path of the checkout; other processes still see the checkout. If the command
starts bubblewrap, bubblewrap fails. All users can read the course's environment.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import zipfile
from collections.abc import Sequence
from pathlib import Path

import pytest

from course_pkg.handout.autograder.bundle import Options, write_autograder
from course_pkg.setup import Places

# The arguments of the script are the copy ($0), the checkout ($1), the cache ($2) and its parent ($3).
MOUNTS = """
set -e
mount --make-rprivate /
if [ -n "$3" ]; then
    mkdir "$0.cache" && mount --bind "$2" "$0.cache"
    mount -t tmpfs -o mode=755 none "$3"
    mkdir -p "$2" && mount --bind "$0.cache" "$2"
fi
mkdir -p "$1" && mount --bind "$0" "$1"
mount --bind /bin/false "$(command -v bwrap)"
cd "$1"
shift 3
exec "$@"
"""


def unpacked_autograder(folder: Path, **options: Path | float | tuple[str, ...] | None) -> Path:
    """Create an autograder, unpack it as Gradescope does, and return the folder of the unpacked files."""
    write_autograder(Options(folder / "autograder.zip", **options))  # type: ignore[arg-type]
    source = folder / "autograder" / "source"
    with zipfile.ZipFile(folder / "autograder.zip") as archive:
        for member in archive.infolist():
            os.chmod(archive.extract(member, source), (member.external_attr >> 16) & 0o777)
    return source


def run_installed(
    source: Path, command: Sequence[str], *, timeout: float
) -> subprocess.CompletedProcess[str]:
    """Run a command in a copy of the course. In the copy, only root can read the checks and the solutions."""
    if os.geteuid() != 0 or not shutil.which("bwrap"):
        pytest.skip("only root can run code as other users")
    places = Places.of()
    closed = [each for each in places.cache.parents if not each.stat().st_mode & 0o001]
    script = [MOUNTS, str(source / "course"), str(places.checkout), str(places.cache)]
    outermost = str(closed[-1]) if closed else ""
    prepare = ["sh", "-c", '"$0" -m course_pkg.cli autograde --prepare && exec "$@"', str(places.python)]
    return subprocess.run(
        ["unshare", "--mount", "sh", "-c", *script, outermost, *prepare, *command],
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )
