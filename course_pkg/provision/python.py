"""The step that makes the virtual environment, on the interpreter that ROS was built for."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from course_pkg.provision.journal import Journal
from course_pkg.provision.places import Places
from course_pkg.provision.stamps import digest

LOCKS = Path(__file__).with_name("locks")
UNWANTED = (
    "a1_coverage.pth"  # it makes every Python of the environment start 30 ms later, nodes and kernels too
)


def lock_file(extra: str) -> Path:
    """Return the pinned requirements of `extra`: "course", "test" or "uv"."""
    return LOCKS / f"{extra}.txt"


def python_key(extra: str) -> str:
    """Return what the environment is made from: the lock, and the interpreter under it."""
    return digest([lock_file(extra).read_bytes(), _base(), sys.version])


def python_intact(places: Places) -> bool:
    """Say whether the environment's interpreter still leads to one that exists."""
    return os.access(places.python, os.X_OK)


def make_environment(places: Places, extra: str, journal: Journal) -> None:
    """Make the virtual environment where it is missing, and install what the lock of `extra` names."""
    from course_pkg.provision import installer

    uv, env = installer.installed_uv(places, journal), installer.uv_environment()
    if not _is_on_base(places):
        journal.run(
            [uv, "venv", "--clear", "--system-site-packages", "--python", _base(), places.venv], env=env
        )
    lock = lock_file(extra)
    journal.run([uv, "pip", "install", "--python", places.python, "--require-hashes", "-r", lock], env=env)
    for unwanted in places.venv.glob(f"lib/python3*/site-packages/{UNWANTED}"):
        unwanted.unlink()


def _base() -> str:
    return str(os.path.realpath(sys._base_executable))  # type: ignore[attr-defined]


def _is_on_base(places: Places) -> bool:
    """Say whether there is an environment, made where it lies now and on this very interpreter."""
    if not python_intact(places):
        return False
    question = "import os, sys; print(os.path.realpath(sys._base_executable), sys.version, sys.prefix)"
    answer = subprocess.run(
        [places.python, "-I", "-c", question], capture_output=True, text=True, check=False
    )
    return answer.stdout.strip() == f"{_base()} {sys.version} {places.venv}"
