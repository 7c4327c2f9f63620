"""The supervisor of one part. It creates the network and the folders, and starts and ends all processes."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from course_pkg.ports import free_port
from course_pkg.sandbox.channel import descendants, end_all_below, fork, send
from course_pkg.sandbox.command_runner import OWN, run_commands
from course_pkg.sandbox.isolation import Isolation
from course_pkg.sandbox.job import PartJob, job_from
from course_pkg.sandbox.linux import confinement, namespaces, users
from course_pkg.sandbox.student_process import message_writer, run_part
from course_pkg.waiting import wait_until

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

MASTER_PORT = 11311
MASTER_TIMEOUT = 30.0  # The master has to start within this time in s; it takes 0.3 s on an idle machine.
CLEAR_TIMEOUT = 5.0  # All processes of a part have to end within this time in s.
MEMORY_INTERVAL = 0.1  # This is the time in s between two measurements of the memory.
# These lines of /proc/PID/status and /proc/PID/smaps_rollup contain the memory of a process in KiB, without
# mapped files (proc(5)). A memory page that several processes share counts for each of these processes.
QUICK = ("RssAnon:", "RssShmem:")
# In this sum, a shared page counts only once: each process counts an equal part of its size.
EXACT = ("Pss_Anon:", "Pss_Shmem:")
OPEN = 4096  # No process of a sandbox has a file descriptor of this number or above.
SIGNALS = {signal.SIGTERM, signal.SIGCHLD}
TOO_MUCH_MEMORY, STUDENT_ENDED, ASKED, TOO_MUCH_DISK = 3, 4, 5, 6  # These are exit statuses of a supervisor.


def supervise(
    job_file: int,
    shell: InteractiveShell,
    fork_server: socket.socket,
    messages: int,
    commands: int,
    *,
    isolation: Isolation,
) -> NoReturn:
    """Start the master, the command runner and the student's process; wait until the student's process ends.

    After SIGTERM, the supervisor stops waiting and ends all processes. All processes of the part end together
    with the supervisor.
    """
    namespaces.die_with_parent()
    signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    namespaces.adopt_orphans()
    with os.fdopen(job_file, "rb") as file:
        job = job_from(file.read())
    folder = _make_folder(isolation, job.hidden)
    port = MASTER_PORT if isolation.namespaces else free_port()
    with socket.create_server(("127.0.0.1", 0)) as listener, open("/proc/self/ns/net") as network:
        _set_environment(folder, port, listener.getsockname()[1])
        for each in job.files:
            each.write(Path(folder))
        if isolation.users:
            users.hand_over(folder, isolation.users.student)
        _start(lambda: _run_master(port, isolation))
        wait_until(lambda: _listens(port), MASTER_TIMEOUT, 0.002)
        student = _start(lambda: _run_student(job, shell, messages, isolation))
        _start(lambda: _run_commands(commands, isolation))
        # The check runner notices the end of the command runner only if no other process has this socket
        # open.
        os.close(commands)
        descriptors = network.fileno(), listener.fileno()
        send(fork_server, {"supervisor": os.getpid(), "port": port, "student": student}, descriptors)
    status = _watch(student, folder, isolation)
    _end_all(folder, isolation)
    os._exit(status)


def _make_folder(isolation: Isolation, hidden: Sequence[str]) -> str:
    """Return the part's work folder.

    If namespaces are available, create a network and a hostname for this part, and hide the paths in
    `hidden`, before the folder is made.
    """
    if isolation.users:
        return users.make_folder(isolation.users)
    if not isolation.namespaces:
        return tempfile.mkdtemp(prefix="course-grading-")
    namespaces.unshare(namespaces.MOUNT | namespaces.NETWORK | namespaces.IPC | namespaces.HOSTNAME)
    for path in hidden:
        namespaces.hide(path)
    namespaces.start_loopback()
    namespaces.mount_memory("/student", size=confinement.DISK, files=confinement.FILES)
    return "/student"


def _set_environment(folder: str, port: int, listener: int) -> None:
    os.chdir(folder)
    state = Path(folder, ".course")
    state.mkdir()
    state.chmod(0o777)
    os.environ.update(
        HOME=folder,
        ROS_MASTER_URI=f"http://localhost:{port}",
        ROS_HOSTNAME="localhost",
        ROS_HOME=str(state),
        ROS_LOG_DIR=str(state),
        COURSE_STATE=str(state),
        COURSE_WORKSPACE=folder,
        COURSE_CHECK_RUNNER=f"127.0.0.1:{listener}",
    )


def _start(work: Callable[[], None]) -> int:
    """Fork a process that ends together with this process; return the process id."""

    def run() -> None:
        namespaces.die_with_parent()
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
        os.dup2(0, 2)
        work()

    return fork(run)


def run_master(port: int) -> None:
    """Run a ROS master on the port `port` until this process ends."""
    import rosmaster.master

    rosmaster.master.Master(port, num_workers=3).start()
    signal.pause()


def _run_master(port: int, isolation: Isolation) -> None:
    os.closerange(3, OPEN)
    if isolation.users:
        users.become(isolation.users.trusted)
    run_master(port)


def _run_student(job: PartJob, shell: InteractiveShell, messages: int, isolation: Isolation) -> None:
    _close_all_but(messages)
    uid = isolation.users.student if isolation.users else 0
    if isolation.users:
        os.environ["TMPDIR"] = tempfile.tempdir = os.environ["ROS_HOME"]
    _confine(lambda: run_part(job, shell, message_writer(messages)), isolation, uid, may_write=True)


def _run_commands(commands: int, isolation: Isolation) -> None:
    _close_all_but(commands)
    sock = socket.socket(fileno=commands)
    uid = isolation.users.commands if isolation.users else 0
    own = OWN if isolation.namespaces else users.own_folder(os.getcwd()) if isolation.users else ""
    _confine(lambda: run_commands(sock, os.getcwd(), own), isolation, uid, may_write=False)


def _confine(work: Callable[[], None], isolation: Isolation, uid: int, *, may_write: bool) -> None:
    folder = os.getcwd()

    def run() -> None:
        os.chdir(folder)  # In a sandbox, a new folder is mounted at this path, so enter the path again.
        work()

    if isolation.namespaces:
        confinement.run_confined(run, may_write=may_write)
    elif isolation.users:
        users.run_confined(run, uid)
    run()


def _close_all_but(descriptor: int) -> None:
    """Close all files except `descriptor` and 0 to 2: the sandboxed process must not inherit them."""
    os.closerange(3, descriptor)
    os.closerange(descriptor + 1, OPEN)


def _watch(student: int, folder: str, isolation: Isolation) -> int:
    """Wait until the student's process ends, the memory or disk limit is exceeded, or SIGTERM arrives.

    Return the exit status of the supervisor.
    """
    while True:
        came = signal.sigtimedwait(SIGNALS, MEMORY_INTERVAL)
        if came is not None and came.si_signo == signal.SIGTERM:
            return ASKED
        if came is not None and os.waitpid(student, os.WNOHANG)[0]:
            return STUDENT_ENDED
        if too_much_memory_below(os.getpid(), confinement.TOGETHER):
            return TOO_MUCH_MEMORY
        if isolation.users and users.disk_is_full(folder, isolation.users):
            return TOO_MUCH_DISK


def too_much_memory_below(ancestor: int, limit: int) -> bool:
    """Return whether all descendants of a process together use more memory than `limit` (bytes).

    Forked processes share most of their memory. A sum that counts shared memory for each process is fast to
    compute. It may be several times too large. The exact sum takes longer, so it is computed only after the
    fast sum has exceeded the limit.
    """
    processes = descendants(ancestor)
    if sum(_memory(pid, "status", QUICK) for pid in processes) <= limit:
        return False
    return sum(map(_exact_memory, processes)) > limit


def _exact_memory(pid: int) -> int:
    try:
        return _memory(pid, "smaps_rollup", EXACT)
    except PermissionError:
        # The exact memory of a protected process cannot be read, so use the fast value.
        return _memory(pid, "status", QUICK)


def _memory(pid: int, file: str, counted: tuple[str, ...]) -> int:
    """Return the memory of a process in bytes, or 0 after its end."""
    try:
        lines = Path(f"/proc/{pid}/{file}").read_text().splitlines()
    except (FileNotFoundError, ProcessLookupError):
        return 0
    return sum(1024 * int(line.split()[1]) for line in lines if line.startswith(counted))


def _end_all(folder: str, isolation: Isolation) -> None:
    """Kill all descendants, wait for their end, and delete the folder.

    When a namespace ends, its mounts end too.
    """
    end_all_below(CLEAR_TIMEOUT)
    if isolation.users:
        users.clear(isolation.users)
        users.remove(folder)
    elif not isolation.namespaces:
        shutil.rmtree(folder, ignore_errors=True)


def _listens(port: int) -> bool:
    with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1.0):
        return True
    return False
