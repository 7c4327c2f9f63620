"""List the packages of the distribution that the course needs on this machine, and install them."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import SetupError
from course_pkg.setup.journal import Journal

DATA = Path(__file__).with_name("platforms.json")
OS_RELEASE = Path("/etc/os-release")
APT_OPTIONS = (
    "--yes",
    "--no-install-recommends",
    "-o",
    "DPkg::Lock::Timeout=600",
    "-o",
    "Dpkg::Use-Pty=0",
    "-o",
    # The option --force-unsafe-io makes dpkg faster. The option is safe: a failed set-up is repeated.
    "Dpkg::Options::=--force-unsafe-io",
    "-o",
    "Dpkg::Options::=--force-confold",
)
LISTS = Path("/var/lib/apt/lists")
STATUS = Path("/var/lib/dpkg/status")
FRESH = 24 * 3600  # apt's package lists are considered up to date for this time in s.
APT = "/usr/bin/apt-get"
# The messages must be in English, because LOCKED matches English messages.
UNATTENDED = ("env", "DEBIAN_FRONTEND=noninteractive", "LC_ALL=C.UTF-8")
LOCKED = re.compile(r"Could not get lock|lock was locked by another process|Unable to (?:acquire|lock)")
# The set-up itself waits up to this time in s for a lock: `apt-get update` and dpkg cannot wait.
LOCK_TIMEOUT = 600.0
RETRY_INTERVAL = 2.0  # This is the time in s between two attempts.
WAITING = (
    "Another program is installing packages. This set-up waits until the other program ends, for "
    "at most 10 minutes."
)


class Platform(NamedTuple):
    """A distribution with ROS 1, and the packages that the course needs on it."""

    name: str
    bootstrap: tuple[str, ...]
    course: tuple[str, ...]
    grade: tuple[str, ...]
    test: tuple[str, ...]


def read_platform(checkout: Path, os_release: Path = OS_RELEASE) -> Platform:
    """Return the platform for the distribution in the file `os_release`, or for its base distribution.

    Raises SetupError if the course does not support the distribution; the error message contains the commands
    for conda.
    """
    data = json.loads(DATA.read_text())
    release = _read_release(os_release)
    for key in ("DEBIAN_CODENAME", "UBUNTU_CODENAME", "VERSION_CODENAME"):
        entry = data["distributions"].get(release.get(key))
        if entry:
            return Platform(
                entry["name"],
                tuple(data["bootstrap"]),
                (*data["course"], *entry["course"]),
                tuple(data["grade"]),
                (*data["grade"], *entry["test"]),
            )
    names = ", ".join(entry["name"] for entry in data["distributions"].values())
    raise SetupError(
        f"The set-up finds ROS 1 only on {names}, but this system is "
        f"{release.get('PRETTY_NAME', 'another system')}. "
        "Use conda on this system:\n"
        f"  conda env create -f {checkout / 'environment.yml'}\n"
        "  conda activate ros-services-course\n"
        "and start again."
    )


def missing_packages(wanted: Iterable[str]) -> list[str]:
    """Return the packages in `wanted` that are not completely installed.

    Raises SetupError if dpkg is missing.
    """
    wanted = list(wanted)
    command = ["dpkg-query", "--show", "--showformat=${Package} ${db:Status-Abbrev}\n", *wanted]
    try:
        listing = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError as error:
        raise SetupError(f"The program dpkg is not installed on this machine ({error.strerror}).") from error
    installed = {line.split()[0] for line in listing.splitlines() if line.split()[1:] == ["ii"]}
    return [name for name in wanted if name not in installed]


def database_state() -> str:
    """Return a string that changes when a package is installed or removed."""
    try:
        return str(STATUS.stat().st_mtime_ns)
    except OSError:
        return ""


def install_packages(names: Sequence[str], journal: Journal, report: Callable[[str], None]) -> None:
    """Install the packages `names`; if another package manager is running, wait until it has ended.

    During the wait, the function `report` is called with a message. Raises SetupError if the user cannot
    install packages, or if a tool fails.
    """
    root = [*become_root(names), *UNATTENDED]

    def run(*command: str) -> None:
        _run_when_unlocked(journal, [*root, *command], report)

    run("dpkg", "--configure", "-a")
    updated = _lists_are_fresh()
    if not updated:
        run(APT, "update", "-q")
    try:
        run(APT, "install", *APT_OPTIONS, *names)
    except SetupError:
        if not updated:
            raise
        # Get new package lists: the old lists may refer to files that the server has replaced.
        run(APT, "update", "-q")
        run(APT, "install", *APT_OPTIONS, *names)


def _run_when_unlocked(journal: Journal, command: Sequence[str], report: Callable[[str], None]) -> None:
    """Run a command, and repeat the command while another program holds a lock that the command needs."""
    deadline = time.monotonic() + LOCK_TIMEOUT
    while True:
        try:
            return journal.run(command, watch=_lock_watcher(report))
        except SetupError as error:
            if not LOCKED.search(str(error)) or time.monotonic() > deadline:
                raise
        report(WAITING)
        time.sleep(RETRY_INTERVAL)


def become_root(names: Sequence[str]) -> list[str]:
    """Return a command prefix such as sudo; raises SetupError if the user cannot run commands as root."""
    advice = "As an administrator, type\n  apt-get update && apt-get install --no-install-recommends " + (
        " ".join(names)
    )
    if not os.access(APT, os.X_OK):
        raise SetupError(
            f"The program {APT} does not exist, so these packages cannot be installed: {' '.join(names)}."
        )
    if os.geteuid() == 0:
        return []
    if not shutil.which("sudo"):
        raise SetupError(
            f"Packages are missing, and only root can install packages. {advice}\nand start again."
        )
    if subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False).returncode == 0:
        return ["sudo", "-n"]
    if not sys.stdin.isatty() or subprocess.run(["sudo", "-v"], check=False).returncode:
        raise SetupError(
            f"Packages are missing, and sudo did not allow the installation. {advice}\nand start again."
        )
    return ["sudo", "-n"]


def _lists_are_fresh() -> bool:
    ages = [path.stat().st_mtime for path in LISTS.glob("*_Packages*")]
    stamp = LISTS.stat().st_mtime if ages else 0.0
    return time.time() - stamp < FRESH


def _lock_watcher(report: Callable[[str], None]) -> Callable[[str], None]:
    def watch(line: str) -> None:
        if line.startswith("Waiting for cache lock"):
            report(WAITING)

    return watch


def _read_release(path: Path) -> dict[str, str]:
    try:
        lines = path.read_text().splitlines()
    except OSError:
        return {}
    pairs = (line.split("=", 1) for line in lines if "=" in line)
    return {key: value.strip("\"'") for key, value in pairs}
