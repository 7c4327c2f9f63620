"""Limits for all processes of one student: a control group (cgroup v2) if possible, or else rlimits."""

from __future__ import annotations

import resource
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from course_pkg.waiting import wait_until

CGROUPS = Path("/sys/fs/cgroup")
GROUP = "ros-course-hub"
CONTROLLERS = ("cpu", "memory", "pids")
MIB = 1 << 20


class Limits(NamedTuple):
    """The limits of one student: `memory` is in MiB; `processes` is the number of processes and threads."""

    memory: int
    processes: int


def group_of_hub(root: Path = CGROUPS) -> Path | None:
    """Return the control group for all students' groups, or None if this process cannot create it."""
    try:
        available = (root / "cgroup.controllers").read_text().split()
        if not set(CONTROLLERS) <= set(available):
            return None
        group = root / GROUP
        group.mkdir(exist_ok=True)
        for folder in (root, group):
            (folder / "cgroup.subtree_control").write_text(" ".join(f"+{name}" for name in CONTROLLERS))
    except OSError:
        return None
    return group


def make_group(hub: Path, student: str, limits: Limits) -> Path:
    """Return the student's control group with its limits; raises OSError if the system refuses this."""
    group = hub / student
    group.mkdir(exist_ok=True)
    (group / "memory.max").write_text(str(limits.memory * MIB))
    (group / "pids.max").write_text(str(limits.processes))
    with suppress(OSError):  # this file is missing on a machine without swap
        (group / "memory.swap.max").write_text("0")
    return group


def enter_group(group: Path) -> None:
    """Move this process into a control group.

    Processes that this process starts later belong to the control group, too.
    """
    (group / "cgroup.procs").write_text("0")


def end_group(group: Path) -> None:
    """Kill all processes in a control group, and delete the group."""
    with suppress(OSError):
        (group / "cgroup.kill").write_text("1")
    wait_until(lambda: _deleted(group), 5.0)


def _deleted(group: Path) -> bool:
    with suppress(OSError):
        group.rmdir()
    return not group.exists()


def set_rlimits(limits: Limits, own_account: bool) -> None:
    """Limit the data memory of this process and of each child, and the number of the account's processes.

    The system counts all processes of an account. Therefore, the number of processes is limited only if
    `own_account` is true.
    """
    _lower(resource.RLIMIT_DATA, limits.memory * MIB)
    if own_account:
        _lower(resource.RLIMIT_NPROC, limits.processes)


def _lower(kind: int, value: int) -> None:
    hard = resource.getrlimit(kind)[1]
    value = value if hard == resource.RLIM_INFINITY else min(value, hard)
    resource.setrlimit(kind, (value, value))


def describe(limits: Limits, group: Path | None, own_account: bool) -> str:
    """Return a sentence for the teacher: which limits apply, and which mechanism enforces them."""
    if group:
        return (
            f"Limits for each student: {limits.memory} MiB, {limits.processes} processes and threads, and a "
            "fair share of the processors (control groups)."
        )
    processes = f", {limits.processes} processes and threads for each student" if own_account else ""
    return (
        f"Limits: {limits.memory} MiB for each process{processes} (rlimits, because this system does not let "
        "the hub make control groups of version 2). A student can use more memory with several processes."
    )
