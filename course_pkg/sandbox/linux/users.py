"""A weaker sandbox for machines that forbid namespaces: other users of the machine, and limits.

For example, Gradescope's containers forbid namespaces; in these containers, the grader runs as root. The
processes of a part run as users who own no other files. The student's code therefore cannot read the
solutions, write the grades, or send signals to the grader. Without namespaces, the student's code can reach
the network, and it can see the names of processes.
"""

from __future__ import annotations

import os
import shutil
import signal
import socket
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple, NoReturn

import psutil

from course_pkg.checking.parts import secret_paths
from course_pkg.errors import SandboxUnavailable
from course_pkg.sandbox.linux import confinement, namespaces
from course_pkg.setup import Places
from course_pkg.waiting import Deadline, wait_until

# Debian, Ubuntu and systemd use no user ids from 60578 to 61183.
FIRST, GROUPS = 60600, 140
KILL_TIMEOUT = 20.0  # All killed processes have to end within this time in s.
SHARED = ("/tmp", "/var/tmp", "/dev/shm", "/run/lock", "/dev/mqueue")  # noqa: S108 -- everybody can write there


class Users(NamedTuple):
    """The user ids of one worker; the group ids are the same numbers."""

    student: int  # This user runs the student's cells.
    commands: int  # This user runs the commands of a check, such as a build of the student's package.
    trusted: int  # This user runs the master and the check runner.
    killer: int  # This user runs only the process that kills the processes of another user.


def reserve() -> tuple[Users, socket.socket]:
    """Reserve users, and return them with a socket; the users are reserved until the socket is closed."""
    for number in range(GROUPS):
        lock = socket.socket(socket.AF_UNIX)
        first = FIRST + number * len(Users._fields)
        with suppress(OSError):
            lock.bind(f"\0ros-services-course-users-{first}")
            users = Users(*range(first, first + len(Users._fields)))
            clear(users)
            return users, lock
        lock.close()
    raise SandboxUnavailable(
        "Other runs of `course grade` on this machine use all accounts for students' code. Wait until one "
        "of these runs has ended."
    )


def become(uid: int) -> None:
    """Become the user `uid`, without privileges; the caller is root and has one thread."""
    os.setgroups([])
    os.setresgid(uid, uid, uid)
    os.setresuid(uid, uid, uid)
    namespaces.give_up_privileges()
    namespaces.be_unreadable()
    # The change of the user has cancelled the earlier call of die_with_parent(), so repeat the call.
    namespaces.die_with_parent()


def run_confined(work: Callable[[], None], uid: int) -> NoReturn:
    """Run a function in this forked process as the user `uid`, with limits and a filter of system calls."""
    os.umask(0o022)
    os.environ.update(USER="student", LOGNAME="student")
    confinement.set_limits()
    become(uid)
    confinement.load_filter()
    try:
        work()
    finally:
        os._exit(0)


def make_folder(users: Users) -> str:
    """Make the folders of a part, and return the student's work folder.

    The folder `commands` next to the work folder belongs to the command runner. This folder also contains the
    command runner's temporary files.
    """
    base = Path(tempfile.mkdtemp(prefix="course-grading-"))
    base.chmod(0o755)
    for name, uid, mode in (("student", users.student, 0o755), ("commands", users.commands, 0o700)):
        (base / name).mkdir()
        os.chown(base / name, uid, uid)
        (base / name).chmod(mode)
    return str(base / "student")


def own_folder(student_folder: str) -> str:
    """Return the command runner's folder, next to the student's folder."""
    return str(Path(student_folder).with_name("commands"))


def hand_over(folder: str, uid: int) -> None:
    """Make the user `uid` the owner of all files in the folder, before a process of this user runs."""
    for path in [Path(folder), *Path(folder).rglob("*")]:
        os.chown(path, uid, uid, follow_symlinks=False)


def clear(users: Users) -> None:
    """Kill all processes that run a student's code, and delete the users' files in shared folders.

    Orphaned processes are killed, too. This function does not kill the check runner, which may not have
    written its record yet. Raises TimeoutError if some processes do not end.
    """
    deadline = Deadline(KILL_TIMEOUT)
    for uid in (users.student, users.commands):
        while any(_processes_of(uid)):
            if deadline.passed:
                raise TimeoutError(f"the processes of the user {uid} do not end")
            _kill_all(uid, users.killer)
    for folder in SHARED:
        for item in _items_of(folder, set(users)):
            _remove(item.path)


def _kill_all(uid: int, killer: int) -> None:
    """Kill all processes of a user in one system call; then no process can fork before its end.

    The killing process has the effective user id `uid`. The killing process may therefore kill the user's
    processes. The real and saved user ids of the killing process are `killer`, so the user's processes cannot
    send signals to it.
    """
    if not (pid := os.fork()):
        try:
            os.setgroups([])
            os.setresuid(killer, uid, killer)
            os.kill(-1, signal.SIGKILL)
        finally:
            os._exit(0)
    os.waitpid(pid, 0)
    wait_until(lambda: not any(_processes_of(uid)), 1.0, 0.005)


def _processes_of(uid: int) -> Iterator[int]:
    """Yield the processes of a user, without zombie processes."""
    for pid in psutil.pids():
        with suppress(psutil.Error, OSError):
            process = psutil.Process(pid)
            if uid in process.uids() and process.status() != psutil.STATUS_ZOMBIE:
                yield pid


def disk_is_full(folder: str, users: Users) -> bool:
    """Return whether a part's folders and the users' files in shared folders exceed the limits."""
    size, count = 0, 0
    items = [item.path for shared in SHARED for item in _items_of(shared, set(users))]
    for path in _below([os.path.dirname(folder), *items]):
        with suppress(OSError):
            size += os.lstat(path).st_blocks * 512
            count += 1
            if size > confinement.DISK or count > confinement.FILES:
                return True
    return False


def _below(paths: Iterable[str]) -> Iterator[str]:
    for path in paths:
        yield path
        for root, folders, files in os.walk(path):
            yield from (os.path.join(root, name) for name in (*folders, *files))


def _items_of(folder: str, uids: set[int]) -> Iterator[os.DirEntry[str]]:
    """Yield the entries directly in the folder `folder` that belong to one of the users."""
    with suppress(OSError), os.scandir(folder) as items:
        for item in items:
            with suppress(OSError):
                if item.stat(follow_symlinks=False).st_uid in uids:
                    yield item


def remove(folder: str) -> None:
    """Delete the folders of a part, after its processes have been killed."""
    _remove(os.path.dirname(folder))


def _remove(path: str) -> None:
    if os.path.isdir(path) and not os.path.islink(path):
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            os.unlink(path)


def refusal(hidden: Iterable[Path] = ()) -> str:
    """Return why this machine cannot run students' code as another user, or "" if it can.

    The user who runs students' code must be able to read the course and the environment. This user must not
    be able to read the checks, the solutions or the paths in `hidden`.
    """
    if os.geteuid() != 0:
        return "Only root can run students' code as another user."
    places = Places.of()
    needed = [places.checkout / "course_pkg" / "__init__.py", places.python, places.environment]
    secret = [*secret_paths(), places.checkout / "solutions", places.checkout / "tests", *hidden]
    try:
        users, lock = reserve()
    except (OSError, SandboxUnavailable) as error:
        return str(error)
    with lock:
        return _as_user(users.student, lambda: _wrong_permissions(needed, secret))


def _wrong_permissions(needed: Iterable[Path], secret: Iterable[Path]) -> str:
    for path in needed:
        if not os.access(path, os.R_OK):
            return f"Other users cannot read {path}."
    for path in secret:
        if any(map(_is_readable, _below([str(path)]))):
            return f"Other users can read {path}; type: chmod 700 {path}"
    return ""


def _is_readable(path: str) -> bool:
    return os.access(path, os.W_OK) or (os.access(path, os.R_OK) and os.path.isfile(path))


def _as_user(uid: int, work: Callable[[], str]) -> str:
    """Return the result of the function `work`, which a forked process runs as the user `uid`."""
    reading, writing = os.pipe()
    if not (pid := os.fork()):
        try:
            become(uid)
            os.write(writing, work().encode())
        except BaseException as error:  # noqa: BLE001 -- the parent reports it
            os.write(writing, f"{type(error).__name__}: {error}".encode())
        finally:
            os._exit(0)
    os.close(writing)
    with open(reading, encoding="utf-8") as file:
        said = file.read()
    os.waitpid(pid, 0)
    return said
