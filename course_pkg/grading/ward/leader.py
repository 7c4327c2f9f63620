"""The leader of one part: makes its network and folders, starts who is needed, watches, and ends them all."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from course_pkg.examiner.scripted import closed_port
from course_pkg.grading import namespaces
from course_pkg.grading.ward import confinement
from course_pkg.grading.ward.errands import run_errands
from course_pkg.grading.ward.job import PartJob, job_from
from course_pkg.grading.ward.student import attend, speaker
from course_pkg.grading.ward.wire import end_all_below, fork, send
from course_pkg.graph.leashed import descendants

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

USUAL_PORT = 11311
CLEARING = 5.0  # s
LOOK = 0.1  # s between looks at the memory
HELD = ("RssAnon:", "RssShmem:")  # proc(5): KiB of its own, and shared without a file
SIGNALS = {signal.SIGTERM, signal.SIGCHLD}
TOO_MUCH_MEMORY, STUDENT_ENDED, ASKED = 3, 4, 5  # how a leader ends; told as its exit status


def lead(
    job_file: int, shell: InteractiveShell, nursery: socket.socket, said: int, errands: int, *, walls: bool
) -> NoReturn:
    """Start master, errands and student; stay until the student has ended or somebody asks for the end."""
    namespaces.die_with_parent()
    signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    namespaces.adopt_orphans()
    with os.fdopen(job_file, "rb") as file:
        job = job_from(json.loads(file.read()))
    folder = _place(walls=walls)
    port = USUAL_PORT if walls else closed_port()
    with socket.create_server(("127.0.0.1", 0)) as desk, open("/proc/self/ns/net") as network:
        _surroundings(folder, port, desk.getsockname()[1])
        _start(lambda: be_master(port))
        _await_port(port)
        student = _start(lambda: _be_student(job, shell, said, walls=walls))
        _start(lambda: _be_errands(errands, walls=walls))
        send(nursery, {"leader": os.getpid(), "port": port}, (network.fileno(), desk.fileno()))
    status = _watch(student)
    _end_all(folder, walls=walls)
    os._exit(status)


def _place(*, walls: bool) -> str:
    """Return the part's work folder, and behind walls be in a network and a hostname of its own."""
    if not walls:
        return tempfile.mkdtemp(prefix="course-grading-")
    namespaces.unshare(namespaces.MOUNT | namespaces.NETWORK | namespaces.IPC | namespaces.HOSTNAME)
    namespaces.start_loopback()
    namespaces.mount_memory("/student", size=confinement.DISK, files=confinement.FILES)
    return "/student"


def _surroundings(folder: str, port: int, desk: int) -> None:
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
        COURSE_EXAMINER=f"127.0.0.1:{desk}",
    )


def _start(work: Callable[[], None]) -> int:
    """Fork a process that ends with this one, and hears no signal but by itself."""

    def alone() -> None:
        namespaces.die_with_parent()
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
        os.dup2(0, 2)
        work()

    return fork(alone)


def be_master(port: int) -> None:
    """Be a master at `port` until this process is ended."""
    import rosmaster.master

    rosmaster.master.Master(port, num_workers=3).start()
    signal.pause()


def _be_student(job: PartJob, shell: InteractiveShell, said: int, *, walls: bool) -> None:
    _keep_only(said)
    _enclosed(lambda: attend(job, shell, speaker(said)), walls=walls, may_write=True)


def _be_errands(errands: int, *, walls: bool) -> None:
    _keep_only(errands)
    sock = socket.socket(fileno=errands)
    _enclosed(lambda: run_errands(sock, os.getcwd(), walls=walls), walls=walls, may_write=False)


def _enclosed(work: Callable[[], None], *, walls: bool, may_write: bool) -> None:
    folder = os.getcwd()

    def there() -> None:
        os.chdir(folder)  # behind a wall it is another
        work()

    confinement.in_cell(there, may_write=may_write) if walls else there()


def _keep_only(descriptor: int) -> None:
    """Close every file but the standard ones and `descriptor`: they would go through the wall."""
    os.closerange(3, descriptor)
    os.closerange(descriptor + 1, 4096)


def _watch(student: int) -> int:
    """Return why it is over: the student's process ended, it took too much memory, or somebody asked."""
    while True:
        came = signal.sigtimedwait(SIGNALS, LOOK)
        if came is not None and came.si_signo == signal.SIGTERM:
            return ASKED
        if came is not None and os.waitpid(student, os.WNOHANG)[0]:
            return STUDENT_ENDED
        if memory_below(os.getpid()) > confinement.TOGETHER:
            return TOO_MUCH_MEMORY


def memory_below(ancestor: int) -> int:
    """Return how many bytes the processes below `ancestor` hold."""
    held = 0
    for pid in descendants(ancestor):
        with suppress(OSError):
            status = Path(f"/proc/{pid}/status").read_text()
            held += sum(1024 * int(line.split()[1]) for line in status.splitlines() if line.startswith(HELD))
    return held


def _end_all(folder: str, *, walls: bool) -> None:
    """Kill all that is below, wait for it, and remove the folder; a namespace takes its mounts along."""
    end_all_below(CLEARING)
    if not walls:
        shutil.rmtree(folder, ignore_errors=True)


def _await_port(port: int) -> None:
    deadline = time.monotonic() + 5.0
    while time.monotonic() < deadline:
        with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1.0):
            return
        time.sleep(0.002)
