"""Starting a command so that the command and its descendants end with their owner.

The command runs below `supervisor.py`, a small process that watches the owner and outlives it
for as long as it takes to clean up. That holds also when the owner is killed by SIGKILL.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO

from course_pkg.errors import GraphError

PROGRAM = Path(__file__).with_name("supervisor.py")


class SupervisedProcess:
    """A command and its descendants, which end with this process at the latest.

    Whatever the command leaves in the background when it ends is ended, too: asked first, and killed after
    2 s. `command` may be empty: then only the clean-up is done when this process is gone. The command runs in
    the folder `cwd`. The clean-up:
    `remove` is a folder to delete, `withdraw` a (master's URI, node's name, node's URI) whose registrations
    to withdraw. `inherit` are descriptors that the command gets. A command in the `foreground` has the
    standard input and the terminal of this process, whose Ctrl-C reaches it, and prints there if there is no
    `output`. Raises GraphError where the command cannot be started.
    """

    def __init__(
        self,
        command: Sequence[str],
        *,
        output: IO[bytes] | int | None = None,
        env: Mapping[str, str] | None = None,
        cwd: Path | None = None,
        remove: Path | None = None,
        withdraw: tuple[str, str, str] | None = None,
        inherit: Sequence[int] = (),
        foreground: bool = False,
    ) -> None:
        self._owner = os.getpid()
        if output is None and not foreground:
            output = subprocess.DEVNULL
        reader, writer = os.pipe()
        try:
            self._process = subprocess.Popen(
                [*_program(writer, remove, withdraw, foreground), *command],
                stdin=None if foreground else subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                env=env,
                cwd=cwd,
                pass_fds=[writer, *inherit],
                start_new_session=not foreground,  # an interrupt of the kernel goes to its process group
            )
        finally:
            os.close(writer)
        self.pid = _started(reader, command, self._process)

    @property
    def returncode(self) -> int | None:
        """The exit status of the command, negative for a signal, or None while any of its processes lives."""
        status = self._process.poll()
        return 128 - status if status is not None and status > 128 else status

    def signal(self, number: int) -> None:
        """Send a signal to the command; one that is gone already is no error."""
        if self.returncode is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def wait(self, timeout: float) -> bool:
        """Return whether all processes of the command are gone, at the latest after `timeout` s."""
        try:
            self._process.wait(timeout)
        except subprocess.TimeoutExpired:
            return False
        return True

    def listening_ports(self) -> frozenset[int]:
        """Return the TCP ports on which the command and its descendants listen."""
        return listening_ports(self.pid)

    def end(self, grace: float = 2.0) -> None:
        """End the command and all its descendants: asked first, and killed after `grace` s.

        In a forked child it does nothing: they are the parent's.
        """
        if os.getpid() != self._owner:
            return
        if self.pid != self._process.pid:
            self.signal(signal.SIGCONT)
            self.signal(signal.SIGINT)
        if self.pid == self._process.pid or not self.wait(grace):
            self._process.send_signal(signal.SIGUSR1)
            self._process.wait()


def listening_ports(pid: int) -> frozenset[int]:
    """Return the TCP ports on which this process and its descendants listen."""
    import psutil  # here: it takes 15 ms, and most programs never ask

    ports: set[int] = set()
    with suppress(psutil.Error):  # it has ended meanwhile
        process = psutil.Process(pid)
        for each in [process, *process.children(recursive=True)]:
            with suppress(psutil.Error):
                sockets = each.net_connections("tcp")
                ports.update(sock.laddr.port for sock in sockets if sock.status == psutil.CONN_LISTEN)
    return frozenset(ports)


def _program(
    report: int, remove: Path | None, withdraw: tuple[str, str, str] | None, foreground: bool
) -> list[str]:
    cleaning = [str(remove or ""), *(withdraw or ("", "", ""))]
    # Isolated and without site: it starts in 20 ms, and nothing on the student's path can break it.
    start = [sys.executable, "-I", "-S", str(PROGRAM), str(os.getpid()), str(report)]
    return [*start, "foreground" if foreground else "", *cleaning]


def _started(reader: int, command: Sequence[str], process: subprocess.Popen[bytes]) -> int:
    """Return the command's process id, which the supervisor reports as soon as the command is running."""
    with os.fdopen(reader) as report:
        answer = report.read()
    if not command:
        return process.pid
    if not answer.isdigit():
        process.wait()
        raise GraphError(f"{command[0]} could not be started: {answer or 'no reason was given'}.")
    return int(answer)
