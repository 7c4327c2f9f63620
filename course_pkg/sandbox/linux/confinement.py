"""Remove the rights of a process before it runs a student's code."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

import psutil

from course_pkg.sandbox.linux import namespaces

STUDENT = 1000  # The student's code inside the sandbox has this uid and gid.
MEMORY = 1 << 30  # The address space of each process has this limit in bytes.
# The address space of a check runner has this limit in bytes; most of it is for the stacks of threads.
CHECK_RUNNER = 2 << 30
TOGETHER = 768 << 20  # The total memory of all processes of a part has this limit in bytes.
# At most this number of processes and threads may run; a launch file with three nodes starts about 60.
PROCESSES = 200
# The files in each of the folders /student and /tmp have this total limit in bytes.
DISK = 128 << 20
MEMORY_FOLDERS = ("/tmp", "/dev/shm")  # noqa: S108 -- each sandbox has its own
# The visible paths in /tmp and /dev/shm are also mounted in the folder `SHADOW`; the variable `SHADOWED`
# lists them.
SHADOW, SHADOWED = "/run/shown", "COURSE_SHOWN"
FILES = 20_000  # Each of the folders /student and /tmp may contain at most this number of files.
FILE = 64 << 20  # A file has at most this size in bytes.
# At most this number of files and sockets may be open. This also limits the memory of socket buffers.
OPEN = 256
PROCESSOR = 120  # A process has at most this CPU time in s.

# These requests (asm-generic/ioctls.h) write input into another user's terminal.
TIOCSTI, TIOCLINUX = 0x5412, 0x541C
# fmt: off
FORBIDDEN = (
    "acct", "add_key", "bpf", "chroot", "clock_adjtime", "clock_settime", "delete_module", "fanotify_init",
    "finit_module", "fsconfig", "fsmount", "fsopen", "fspick", "init_module", "io_uring_enter",
    "io_uring_register", "io_uring_setup", "kexec_file_load", "kexec_load", "keyctl", "lookup_dcookie",
    "mbind", "memfd_create", "memfd_secret", "migrate_pages", "mount", "mount_setattr", "move_mount",
    "move_pages", "name_to_handle_at", "open_by_handle_at", "open_tree", "perf_event_open", "personality",
    "pidfd_getfd", "pivot_root", "process_vm_readv", "process_vm_writev", "ptrace", "quotactl", "reboot",
    "request_key", "setns", "settimeofday", "shmget", "swapoff", "swapon", "syslog", "umount2", "unshare",
    "userfaultfd", "vhangup",
)
# fmt: on


def run_confined(work: Callable[[], None], *, may_write: bool) -> NoReturn:
    """Run a function without privileges, in new user and process namespaces, and with new folders in memory.

    Call this function in a forked process that is root in its user namespace. This function never returns:
    when `work` ends, the function ends all processes that `work` started. If `may_write` is false, /student
    is read-only.
    """
    namespaces.die_with_parent()
    namespaces.unshare(
        namespaces.USER
        | namespaces.MOUNT
        | namespaces.PROCESS
        | namespaces.IPC
        | namespaces.HOSTNAME
        | namespaces.CGROUP
    )
    namespaces.become(STUDENT, STUDENT, outside=(0, 0))
    _mount_memory_folders()
    if not may_write:
        namespaces.make_read_only("/student")
    if first := os.fork():
        _wait_and_exit(first)
    namespaces.die_with_parent()
    namespaces.mount_processes()
    if second := os.fork():
        _reap_until(second)
    set_limits()
    namespaces.give_up_privileges()
    load_filter()
    try:
        work()
    finally:
        os._exit(0)


def innermost(outer: int) -> int:
    """Return the id of the process that runs `work`; `outer` is the process that called run_confined()."""
    with suppress(psutil.NoSuchProcess, ValueError):  # min() raises ValueError if a process has ended.
        for _ in range(2):  # run_confined() forks twice.
            outer = min(psutil.Process(outer).children(), key=psutil.Process.create_time).pid
    return outer


def _mount_memory_folders() -> None:
    """Mount new folders in memory, and mount the paths of shadowed_paths() in these folders again."""
    shadows = {path: f"{SHADOW}/{number}" for number, path in enumerate(shadowed_paths())}
    for path, place in shadows.items():
        if os.path.isdir(path):
            namespaces.bind(path, place)
    for folder in MEMORY_FOLDERS:
        namespaces.mount_memory(folder, size=DISK, files=FILES)
    for path, place in shadows.items():
        os.makedirs(path if os.path.isdir(place) else os.path.dirname(path), exist_ok=True)
        if not os.path.isdir(place):
            open(path, "w").close()
        namespaces.bind(place, path)


def shadowed_paths() -> list[str]:
    """Return the visible paths of the outer sandbox in /tmp and /dev/shm, such as a checkout in /tmp."""
    return [path for path in os.environ.get(SHADOWED, "").split(os.pathsep) if path]


def set_limits() -> None:
    """Set the limits of a process that runs a student's code."""
    namespaces.limit(
        AS=MEMORY,
        NPROC=PROCESSES,
        FSIZE=FILE,
        NOFILE=OPEN,
        CPU=PROCESSOR,
        CORE=0,
        MEMLOCK=0,
        MSGQUEUE=0,
    )


def load_filter() -> None:
    """Refuse dangerous system calls of this process and of all its later child processes."""
    _filter().load()


def write_filter(path: Path) -> None:
    """Write the filter of system calls to the file at the path `path`, for bubblewrap."""
    with path.open("wb") as file:
        _filter().export_bpf(file)


def _filter() -> Any:  # noqa: ANN401 -- libseccomp's binding has no types
    """Return a filter that refuses system calls that attacks use and that no exercise needs."""
    import errno

    import seccomp

    refused = seccomp.ERRNO(errno.EPERM)
    rules = seccomp.SyscallFilter(seccomp.ALLOW)
    for call in FORBIDDEN:
        rules.add_rule(refused, call)
    users = seccomp.Arg(0, seccomp.MASKED_EQ, namespaces.USER, namespaces.USER)
    rules.add_rule(refused, "clone", users)
    # A filter cannot read the flags of clone3, so this rule refuses every call of clone3.
    rules.add_rule(seccomp.ERRNO(errno.ENOSYS), "clone3")
    for request in (TIOCSTI, TIOCLINUX):
        rules.add_rule(refused, "ioctl", seccomp.Arg(1, seccomp.MASKED_EQ, 0xFFFFFFFF, request))
    return rules


def _wait_and_exit(child: int) -> NoReturn:
    os.waitpid(child, 0)
    os._exit(0)


def _reap_until(child: int) -> NoReturn:
    """Act as the first process of a process namespace: reap orphans, and exit when the child has ended."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    while os.wait()[0] != child:
        pass
    os._exit(0)
