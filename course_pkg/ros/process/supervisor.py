"""This process runs between an owner and a command. It ends the command after the end of the owner.

`supervised.py` runs this file as a script, in an interpreter without site-packages. The script starts in 20
ms, because it imports the course and its libraries only at the end, for the clean-up. The script reads /proc
itself, because the import of psutil is slow.

usage: supervisor.py OWNER REPORT FOREGROUND REMOVE MASTER NODE URI [COMMAND …]
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import sys
import time
from contextlib import suppress

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36  # These values are from linux/prctl.h.
# A terminal sends these signals to all processes of a process group.
FROM_TERMINAL = (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT)
FORWARDED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# A command expects the default handlers of these signals. Python or this program has changed the handlers.
CHANGED = (*FORWARDED, *FROM_TERMINAL, signal.SIGCHLD, signal.SIGUSR1, signal.SIGPIPE, signal.SIGXFSZ)
GRACE = 2.0  # The supervisor waits this time in s between SIGTERM and SIGKILL.
COURSE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
# Without pidfd, the supervisor polls the parent's process id; this is the time in ms between two polls.
INTERVAL = 200


class Supervisor:
    """Supervises one command, or no command, for one owner process."""

    def __init__(self, owner: int, report: int, command: list[str], *, foreground: bool = False) -> None:
        self.owner = owner
        self.status: int | None = None
        self.urgent = False
        self._poll, self._pidfd = select.poll(), _pidfd(owner)
        self._signalled, wakeup = os.pipe()
        for end in (self._signalled, wakeup):
            os.set_blocking(end, False)
            os.set_inheritable(end, False)
        signal.set_wakeup_fd(wakeup, warn_on_full_buffer=False)
        self._poll.register(self._signalled, select.POLLIN)
        if self._pidfd is not None:
            self._poll.register(self._pidfd, select.POLLIN)
        _prctl(PR_SET_CHILD_SUBREAPER, 1)
        for number in (signal.SIGCHLD, *FORWARDED, signal.SIGUSR1):
            signal.signal(number, self._handle)
        for number in FROM_TERMINAL if foreground else ():
            # The terminal also sends this signal to the command, so the supervisor ignores the signal.
            signal.signal(number, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_SETMASK, ())  # Unblock the signals that the owner may have blocked.
        os.set_inheritable(report, False)
        self.child = self._start(command, report) if command else None
        os.close(report)

    def run(self) -> int:
        """Wait for the end of the command or of the owner; return the command's exit status, or 0."""
        while self.owner_lives() and self.status is None and not self.urgent:
            self._wait(None if self._pidfd is not None else INTERVAL)
            self._reap()
        ports = self._end_descendants()
        if ports and not self.urgent and "ROS_MASTER_URI" in os.environ:
            _withdraw_registered(ports)
        return self.status or 0

    def owner_lives(self) -> bool:
        """Return whether the owner (the parent of this process) is still running."""
        return os.getppid() == self.owner

    def _start(self, command: list[str], report: int) -> int:
        failed, fail = os.pipe()  # The system closes the pipe `fail` as soon as the command is running.
        child = os.fork()
        if child == 0:
            _become(command, fail)
        os.close(fail)
        with os.fdopen(failed, "rb") as reader:
            reason = reader.read()
        os.write(report, reason or str(child).encode())
        return child

    def _handle(self, number: int, _frame: object) -> None:
        if number == signal.SIGUSR1:
            self.urgent = True
        elif number in FORWARDED and self.child and self.status is None:
            os.kill(self.child, number)

    def _wait(self, milliseconds: float | None) -> None:
        self._poll.poll(milliseconds)
        with suppress(BlockingIOError):
            os.read(self._signalled, 512)

    def _reap(self) -> bool:
        """Collect the exit statuses of ended children, and return whether any child is still running."""
        while True:
            try:
                pid, status = os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:
                return False
            if pid == 0:
                return True
            if pid == self.child:
                self.status = status

    def _end_descendants(self) -> frozenset[int]:
        """End all descendants with SIGTERM, or with SIGKILL after `GRACE` s.

        Orphaned descendants become children of this process. Another supervisor among the descendants is
        killed `GRACE` s later, because it needs this time to clean up. The returned set contains the
        listening ports of the killed processes.
        """
        ports: frozenset[int] = frozenset()
        deadline = time.monotonic() + (0 if self.urgent else GRACE)
        if self._reap() and not self.urgent:
            _signal_all((signal.SIGCONT, signal.SIGTERM), self.child)
        if self._pidfd is not None and not self.owner_lives():
            self._poll.unregister(self._pidfd)
            self._pidfd = None
        while self._reap():
            if self.urgent:
                deadline = min(deadline, time.monotonic())
            if (late := time.monotonic() - deadline) >= 0:
                if not self.urgent:
                    ports |= _listening_ports()
                _signal_all((signal.SIGKILL,), self.child, supervisors=late > GRACE)
            self._wait(20)
        return ports


def _pidfd(pid: int) -> int | None:
    try:
        return os.pidfd_open(pid)
    except (AttributeError, OSError):
        return None


def _prctl(option: int, value: int) -> None:
    """Set an option of this process on Linux; on other systems, do nothing."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _become(command: list[str], fail: int) -> None:
    _prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    try:
        for number in CHANGED:
            signal.signal(number, signal.SIG_DFL)
        signal.set_wakeup_fd(-1)
        os.execvp(command[0], command)  # noqa: S606 -- the command needs no shell
    except OSError as error:
        os.write(fail, (error.strerror or str(error)).encode())
    finally:
        os._exit(127)


def _signal_all(numbers: tuple[int, ...], child: int | None, *, supervisors: bool = True) -> None:
    for pid in descendants(os.getpid()) or ([child] if child else []):
        for number in numbers if supervisors or not _is_supervisor(pid) else ():
            with suppress(ProcessLookupError, PermissionError):
                os.kill(pid, number)


def _is_supervisor(pid: int) -> bool:
    """Return whether the process `pid` runs this file."""
    try:
        with open(f"/proc/{pid}/cmdline", "rb") as line:
            return os.path.abspath(__file__).encode() in line.read().split(b"\0")
    except OSError:
        return False


def descendants(root: int) -> list[int]:
    """Return the descendants of the process `root`, parents before children.

    On a system without /proc, the list is empty.
    """
    children: dict[int, list[int]] = {}
    for entry in os.listdir("/proc") if os.path.isdir("/proc") else []:
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", "rb") as stat:
                    # The name of the process may contain brackets, so search for the last bracket.
                    parent = int(stat.read().rpartition(b")")[2].split()[1])
            except OSError:
                continue
            children.setdefault(parent, []).append(int(entry))
    found, todo = [], [root]
    while todo:
        below = children.get(todo.pop(0), [])
        found += below
        todo += below
    return found


def _import_libraries() -> None:
    """Add the folders of the course and of its libraries to the import path.

    The interpreter's options -I and -S exclude the folders of libraries from the import path.
    """
    import site

    site.main()
    sys.path.insert(0, COURSE)


def _listening_ports() -> frozenset[int]:
    with suppress(ImportError):  # The course's folder may have been deleted.
        _import_libraries()
        from course_pkg.ros.process.supervised import listening_ports

        return listening_ports(os.getpid())
    return frozenset()


def _withdraw_registered(ports: frozenset[int]) -> None:
    """Unregister the killed nodes that listened on these ports."""
    with suppress(ImportError):
        from course_pkg.errors import GraphError
        from course_pkg.ros.protocol.master_api import MasterClient, master_uri
        from course_pkg.ros.protocol.registrations import registered_at, withdraw

        with suppress(GraphError):
            withdraw(MasterClient(master_uri()), registered_at(ports))


def _clean_up(folder: str, master_uri: str, node: str, node_uri: str) -> None:
    """Unregister the owner's node, and delete the folder.

    If `master_uri` is empty, the node is not unregistered. If `folder` is empty, nothing is deleted.
    """
    if master_uri:
        with suppress(ImportError):
            sys.path.insert(0, COURSE)
            from course_pkg.errors import GraphError
            from course_pkg.ros.protocol.master_api import MasterClient
            from course_pkg.ros.protocol.registrations import withdraw_node

            with suppress(GraphError):  # The master may have ended too.
                withdraw_node(MasterClient(master_uri), node, node_uri)
    if folder:
        import shutil

        shutil.rmtree(folder, ignore_errors=True)


def main(argv: list[str]) -> int:
    """Run the command until the command or the owner ends, and clean up; return the exit status."""
    owner, report, foreground, *cleaning = argv[1:8]
    supervisor = Supervisor(int(owner), int(report), argv[8:], foreground=bool(foreground))
    status = supervisor.run()
    if not supervisor.owner_lives() or supervisor.child:
        _clean_up(*cleaning)
    return os.waitstatus_to_exitcode(status) if status >= 0 else 0


if __name__ == "__main__":
    code = main(sys.argv)
    os._exit(128 - code if code < 0 else code)
