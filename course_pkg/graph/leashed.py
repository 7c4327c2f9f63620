"""The process between an owner and a command: it ends the command when the owner is gone.

Run as a script by `leash.py`, on the bare interpreter; so it imports nothing of the course and little else.
usage: leashed.py OWNER REPORT REMOVE MASTER NODE URI [COMMAND …]
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import sys
import time
from contextlib import suppress

TYPE_CHECKING = False
if TYPE_CHECKING:  # typing takes longer to import than all the rest
    from typing import Any

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36  # linux/prctl.h
FORWARDED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
GRACE = 2.0  # s between asking descendants to end and killing them
COURSE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LOOK = 200  # ms between looks at the parent where the system has no pidfd


class Leashed:
    """One command, or none, below one owner."""

    def __init__(self, owner: int, report: int, command: list[str]) -> None:
        self.owner = owner
        self.status: int | None = None
        self.hurry = False
        self._poll, self._pidfd = select.poll(), _pidfd(owner)
        wake, wakened = os.pipe()
        for end in (wake, wakened):
            os.set_blocking(end, False)
            os.set_inheritable(end, False)
        signal.set_wakeup_fd(wakened, warn_on_full_buffer=False)
        self._wake = wake
        self._poll.register(wake, select.POLLIN)
        if self._pidfd is not None:
            self._poll.register(self._pidfd, select.POLLIN)
        _prctl(PR_SET_CHILD_SUBREAPER, 1)
        for number in (signal.SIGCHLD, *FORWARDED, signal.SIGUSR1):
            signal.signal(number, self._heard)
        os.set_inheritable(report, False)
        self.child = self._start(command, report) if command else None
        os.close(report)

    def hold(self) -> int:
        """Return the command's exit status once it has ended, or 0 once the owner has."""
        while self.owner_lives() and self.status is None and not self.hurry:
            self._wait(None if self._pidfd is not None else LOOK)
            self._reap()
        ports = self._end_descendants()
        if ports and not self.hurry and "ROS_MASTER_URI" in os.environ:
            _take_back(ports)
        return self.status or 0

    def owner_lives(self) -> bool:
        """Say whether the owner is still there; it is the parent of this process."""
        return os.getppid() == self.owner

    def _start(self, command: list[str], report: int) -> int:
        failed, fail = os.pipe()  # closes by itself when the command is running
        child = os.fork()
        if child == 0:
            _become(command, fail)
        os.close(fail)
        with os.fdopen(failed, "rb") as reader:
            reason = reader.read()
        os.write(report, reason or str(child).encode())
        return child

    def _heard(self, number: int, _frame: object) -> None:
        if number == signal.SIGUSR1:
            self.hurry = True
        elif number in FORWARDED and self.child and self.status is None:
            os.kill(self.child, number)

    def _wait(self, milliseconds: float | None) -> None:
        self._poll.poll(milliseconds)
        with suppress(BlockingIOError):
            os.read(self._wake, 512)

    def _reap(self) -> bool:
        """Collect what has ended, and say whether any child is left."""
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
        """Ask all to end, kill those that do not; who loses its parent becomes a child of this process.

        Return on which ports those listened that were killed.
        """
        ports: frozenset[int] = frozenset()
        deadline = time.monotonic() + (0 if self.hurry else GRACE)
        if self._reap() and not self.hurry:
            _signal_all((signal.SIGCONT, signal.SIGTERM), self.child)
        if self._pidfd is not None and not self.owner_lives():
            self._poll.unregister(self._pidfd)
            self._pidfd = None
        while self._reap():
            if time.monotonic() >= deadline or self.hurry:
                if not self.hurry:
                    ports |= _listening(descendants(os.getpid()))
                _signal_all((signal.SIGKILL,), self.child)
            self._wait(20)
        return ports


def _pidfd(pid: int) -> int | None:
    try:
        return os.pidfd_open(pid)
    except (AttributeError, OSError):
        return None


def _prctl(option: int, value: int) -> None:
    """Ask Linux for a favour; elsewhere the looks at the parent have to do."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _become(command: list[str], fail: int) -> None:
    _prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    try:
        for number in (signal.SIGCHLD, *FORWARDED, signal.SIGUSR1):
            signal.signal(number, signal.SIG_DFL)
        signal.set_wakeup_fd(-1)
        os.execvp(command[0], command)  # noqa: S606 -- no shell is what is wanted
    except OSError as error:
        os.write(fail, (error.strerror or str(error)).encode())
    finally:
        os._exit(127)


def _signal_all(numbers: tuple[int, ...], child: int | None) -> None:
    for pid in descendants(os.getpid()) or ([child] if child else []):
        for number in numbers:
            with suppress(ProcessLookupError, PermissionError):
                os.kill(pid, number)


def descendants(root: int) -> list[int]:
    """Return the processes below `root`, parents before their children; empty where there is no /proc."""
    children: dict[int, list[int]] = {}
    for entry in os.listdir("/proc") if os.path.isdir("/proc") else []:
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", "rb") as stat:
                    parent = int(stat.read().rpartition(b")")[2].split()[1])  # the name may hold brackets
            except OSError:
                continue
            children.setdefault(parent, []).append(int(entry))
    found, todo = [], [root]
    while todo:
        below = children.get(todo.pop(0), [])
        found += below
        todo += below
    return found


def _listening(pids: list[int]) -> frozenset[int]:
    with suppress(ImportError):  # the checkout is gone
        sys.path.append(COURSE)
        from course_pkg.graph.ports import listening_ports

        return listening_ports(pids) or frozenset()
    return frozenset()


def _take_back(ports: frozenset[int]) -> None:
    """Withdraw what was registered at these ports: nodes that were killed could not sign off."""
    with suppress(ImportError):
        from course_pkg.graph.estate import registered_at, take_back

        take_back(registered_at(ports))


def forget(master_uri: str, node: str, node_uri: str) -> None:
    """Withdraw from the master what the dead node registered, and nothing of a successor by the same name."""
    from xmlrpc.client import ServerProxy

    master: Any = ServerProxy(master_uri)
    publishers, subscribers, services = master.getSystemState(node)[2]
    for topic in [name for name, nodes in publishers if node in nodes]:
        master.unregisterPublisher(node, topic, node_uri)
    for topic in [name for name, nodes in subscribers if node in nodes]:
        master.unregisterSubscriber(node, topic, node_uri)
    for service in [name for name, nodes in services if node in nodes]:
        uri = str(master.lookupService(node, service)[2])
        if _dead(uri):
            master.unregisterService(node, service, uri)


def _dead(uri: str) -> bool:
    import socket

    host, _, port = uri.rpartition("://")[2].rpartition(":")
    try:
        socket.create_connection((host, int(port)), timeout=1).close()
    except ConnectionRefusedError:
        return True
    except OSError:
        return False
    return False


def _execute_will(folder: str, master_uri: str, node: str, node_uri: str) -> None:
    if master_uri:
        import socket
        from http.client import HTTPException
        from xmlrpc.client import Error

        socket.setdefaulttimeout(2.0)
        with suppress(OSError, Error, HTTPException):  # gone too, and with it what there was to withdraw
            forget(master_uri, node, node_uri)
    if folder:
        import shutil

        shutil.rmtree(folder, ignore_errors=True)


def main(argv: list[str]) -> int:
    """Hold the command until it or the owner ends, then clear up."""
    owner, report, *will = argv[1:7]
    leashed = Leashed(int(owner), int(report), argv[7:])
    status = leashed.hold()
    if not leashed.owner_lives() or leashed.child:
        _execute_will(*will)
    return os.waitstatus_to_exitcode(status) if status >= 0 else 0


if __name__ == "__main__":
    code = main(sys.argv)
    os._exit(128 - code if code < 0 else code)
