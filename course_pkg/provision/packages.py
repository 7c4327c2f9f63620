"""The step that installs the distribution's packages."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.provision.journal import Journal

APT_OPTIONS = (
    "--yes",
    "--no-install-recommends",
    "-o",
    "DPkg::Lock::Timeout=600",
    "-o",
    "Dpkg::Use-Pty=0",
    "-o",
    "Dpkg::Options::=--force-unsafe-io",  # fewer syncs: a power failure is repaired by starting again
    "-o",
    "Dpkg::Options::=--force-confold",
)
LISTS = Path("/var/lib/apt/lists")
STATUS = Path("/var/lib/dpkg/status")
FRESH = 24 * 3600  # s that apt's lists are taken for up to date
APT = "/usr/bin/apt-get"
AS_ASKED = ("env", "DEBIAN_FRONTEND=noninteractive", "LC_ALL=C.UTF-8")  # no questions, and words known here
LOCKED = re.compile(r"Could not get lock|lock was locked by another process|Unable to (?:acquire|lock)")
PATIENCE = 600.0  # s; only apt's installing can itself wait for a lock, its update and dpkg give up at once
AGAIN = 2.0  # s between two attempts
WAITING = "Another program is installing packages; waiting for it (10 minutes at most)."


def missing_packages(wanted: Iterable[str]) -> list[str]:
    """Return those of `wanted` that are not installed, or only half."""
    wanted = list(wanted)
    command = ["dpkg-query", "--show", "--showformat=${Package} ${db:Status-Abbrev}\n", *wanted]
    try:
        listing = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError as error:
        raise SetupError(f"There is no dpkg on this machine ({error.strerror}).") from error
    installed = {line.split()[0] for line in listing.splitlines() if line.split()[1:] == ["ii"]}
    return [name for name in wanted if name not in installed]


def database_state() -> str:
    """Return a text that changes whenever a package is installed or removed."""
    try:
        return str(STATUS.stat().st_mtime_ns)
    except OSError:
        return ""


def install_packages(names: Sequence[str], journal: Journal, say: Callable[[str], None]) -> None:
    """Install `names`, waiting for another package manager that is at work."""
    root = [*become_root(names), *AS_ASKED]

    def run(*command: str) -> None:
        _patiently(journal, [*root, *command], say)

    run("dpkg", "--configure", "-a")
    updated = _lists_are_fresh()
    if not updated:
        run(APT, "update", "-q")
    try:
        run(APT, "install", *APT_OPTIONS, *names)
    except SetupError:
        if not updated:
            raise
        run(APT, "update", "-q")  # lists of this morning name files that are gone
        run(APT, "install", *APT_OPTIONS, *names)


def _patiently(journal: Journal, command: Sequence[str], say: Callable[[str], None]) -> None:
    """Run `command`, again and again while another program holds a lock that it needs."""
    deadline = time.monotonic() + PATIENCE
    while True:
        try:
            return journal.run(command, watch=_lock_watcher(say))
        except SetupError as error:
            if not LOCKED.search(str(error)) or time.monotonic() > deadline:
                raise
        say(WAITING)
        time.sleep(AGAIN)


def become_root(names: Sequence[str]) -> list[str]:
    """Return the words to put before a command to run it as root; raise where that cannot be."""
    advice = "As an administrator, type\n  apt-get update && apt-get install --no-install-recommends " + (
        " ".join(names)
    )
    if not os.access(APT, os.X_OK):
        raise SetupError(f"There is no {APT} to install with: {' '.join(names)}.")
    if os.geteuid() == 0:
        return []
    if not shutil.which("sudo"):
        raise SetupError(f"Packages are missing, and only root can install them. {advice}\nand start again.")
    if subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False).returncode == 0:
        return ["sudo", "-n"]
    if not sys.stdin.isatty() or subprocess.run(["sudo", "-v"], check=False).returncode:
        raise SetupError(
            f"Packages are missing, and sudo did not let you install them. {advice}\nand start again."
        )
    return ["sudo", "-n"]


def _lists_are_fresh() -> bool:
    ages = [path.stat().st_mtime for path in LISTS.glob("*_Packages*")]
    stamp = LISTS.stat().st_mtime if ages else 0.0
    return time.time() - stamp < FRESH


def _lock_watcher(say: Callable[[str], None]) -> Callable[[str], None]:
    def watch(line: str) -> None:
        if line.startswith("Waiting for cache lock"):
            say(WAITING)

    return watch
