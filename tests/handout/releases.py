"""Functions with which tests release a student edition and run commands in this edition."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from course_pkg.handout.commands import NO_COMMANDS
from course_pkg.handout.release import Options, release

ROOT = Path(__file__).parents[2]


def make_release(out: Path, path: str = "", chapters: tuple[str, ...] = ()) -> Path:
    """Run `course release`, and return the folder of the release."""
    assert release(Options(out, path, chapters), NO_COMMANDS) == 0
    return out


def files_of(folder: Path) -> dict[str, bytes]:
    """Return the contents of all files in the edition, except git's files; the keys are the paths."""
    found = (path for path in folder.rglob("*") if path.is_file())
    names = {str(path.relative_to(folder)): path for path in found}
    return {name: path.read_bytes() for name, path in names.items() if not name.startswith(".git/")}


def git(folder: Path, *arguments: str) -> str:
    """Run git in a folder, and return its output."""
    command = ["git", "-C", str(folder), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def python_in(edition: Path, program: str, **variables: str) -> str:
    """Run a program that imports the edition, and return its output."""
    paths = os.environ["PYTHONPATH"].split(os.pathsep)
    env = {
        **os.environ,
        **variables,
        "PYTHONPATH": os.pathsep.join([str(edition), *(path for path in paths if path != str(ROOT))]),
    }
    done = subprocess.run(
        [sys.executable, "-P" if sys.version_info >= (3, 11) else "-B", "-c", program],
        cwd=edition,
        env=env,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
