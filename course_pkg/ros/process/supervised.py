"""Start a command. The command and all its descendants end with their owner, the process that started it.

The command is a child of `supervisor.py`, a small process that observes the owner. When the owner has ended,
even after SIGKILL, the supervisor ends the command and cleans up.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from course_pkg.errors import GraphError

PROGRAM = Path(__file__).with_name("supervisor.py")
# A program that loads this library executes Python code in its own process.
INTERPRETER = re.compile(r"(?<=/)libpython[^/\s]*$", re.MULTILINE)


class SupervisedProcess:
    """A command and its descendants. They end when this process ends, or earlier.

    When the command ends, its background processes get SIGTERM. After 2 s, they get SIGKILL. The command runs
    in the folder `cwd` and inherits the file descriptors in `inherit`. At the end, the supervisor deletes the
    folder `remove`. The supervisor also unregisters the node in `withdraw`: the master's URI, the node's name
    and the node's URI. If `command` is empty, the supervisor only waits for the end of this process, and then
    cleans up.

    If `foreground` is true, the command uses the standard input and the terminal of this process, and
    receives Ctrl-C. If `output` is None, the command also prints to the terminal. Raises GraphError if the
    command cannot be started.
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
                # The command runs in a new session, so an interrupt of the kernel does not reach the command.
                start_new_session=not foreground,
            )
        finally:
            os.close(writer)
        self.pid = _started(reader, command, self._process)

    @property
    def returncode(self) -> int | None:
        """The command's exit status, or None while any of its processes is running.

        The exit status is negative if a signal ended the command. A positive status, such as 255, is the
        status that the command returned.
        """
        status = self._process.poll()
        return 128 - status if status is not None and 128 < status < 128 + signal.NSIG else status

    def signal(self, number: int) -> None:
        """Send a signal to the command, if it is still running."""
        if self.returncode is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait up to `timeout` s; return whether all processes of the command have ended.

        Without `timeout`, wait until they have ended.
        """
        try:
            self._process.wait(timeout)
        except subprocess.TimeoutExpired:
            return False
        return True

    def listening_ports(self, *, descendants: bool = True) -> frozenset[int]:
        """Return the TCP ports on which the command and its descendants listen.

        If `descendants` is false, the ports of the descendants are omitted.
        """
        return listening_ports(self.pid, descendants=descendants)

    def programs(self) -> set[tuple[str, str]]:
        """Return (SHA-256 sum, name) of each file that the command and its descendants execute.

        If a process has loaded the library of an interpreter (libpython), the library is also in the result.
        In the result, the sum of the library is an empty string. The result is empty if the kernel does not
        report the executed files, for example in an emulator.
        """
        import psutil  # This import takes 15 ms, and most programs do not need it.

        with suppress(OSError, psutil.Error):
            if os.path.samefile(f"/proc/{self._process.pid}/exe", sys.executable):
                processes = psutil.Process(self._process.pid).children(recursive=True)
                return {each for process in processes for each in _executed(process.pid)}
        return set()

    def end(self, grace: float = 2.0) -> None:
        """End the command and its descendants with SIGINT. After `grace` s, kill them.

        In a forked child, this method does nothing.
        """
        if os.getpid() != self._owner:
            return
        if self.pid != self._process.pid:
            self.signal(signal.SIGCONT)
            self.signal(signal.SIGINT)
        if self.pid == self._process.pid or not self.wait(grace):
            self._process.send_signal(signal.SIGUSR1)
            self._process.wait()


@contextmanager
def temporary_folder(prefix: str) -> Iterator[Path]:
    """Yield a new folder; delete it after the `with` block, or when this process ends, even after SIGKILL."""
    folder = Path(tempfile.mkdtemp(prefix=prefix))
    guard = SupervisedProcess([], remove=folder)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        guard.end()


def listening_ports(pid: int, *, descendants: bool = True) -> frozenset[int]:
    """Return the TCP ports on which this process and its descendants listen.

    If `descendants` is false, the ports of the descendants are omitted.
    """
    import psutil  # This import takes 15 ms, and most programs do not need it.

    ports: set[int] = set()
    with suppress(psutil.Error):  # The process may have ended.
        process = psutil.Process(pid)
        for each in [process, *(process.children(recursive=True) if descendants else [])]:
            with suppress(psutil.Error):
                sockets = each.net_connections("tcp")
                ports.update(sock.laddr.port for sock in sockets if sock.status == psutil.CONN_LISTEN)
    return frozenset(ports)


def _executed(pid: int) -> list[tuple[str, str]]:
    """Return (SHA-256 sum, name) of each file that a process executes, or [] if the process has ended."""
    try:
        name = Path(os.readlink(f"/proc/{pid}/exe")).name
        digest = hashlib.sha256(Path(f"/proc/{pid}/exe").read_bytes()).hexdigest()
        interpreter = INTERPRETER.search(Path(f"/proc/{pid}/maps").read_text("utf-8", "replace"))
    except (FileNotFoundError, ProcessLookupError):
        return []
    except OSError:  # The process has made its data in /proc unreadable.
        return [("", "a hidden program")]
    return [(digest, name), *([("", interpreter[0])] if interpreter else [])]


def _program(
    report: int, remove: Path | None, withdraw: tuple[str, str, str] | None, foreground: bool
) -> list[str]:
    cleaning = [str(remove or ""), *(withdraw or ("", "", ""))]
    # Python's options -I and -S make the supervisor start in 20 ms and ignore modules on the student's import
    # path.
    start = [sys.executable, "-I", "-S", str(PROGRAM), str(os.getpid()), str(report)]
    return [*start, "foreground" if foreground else "", *cleaning]


def _started(reader: int, command: Sequence[str], process: subprocess.Popen[bytes]) -> int:
    """Return the command's process id as soon as the command is running."""
    with os.fdopen(reader) as report:
        answer = report.read()
    if not command:
        return process.pid
    if not answer.isdigit():
        process.wait()
        raise GraphError(f"{command[0]} could not be started: {answer or 'the reason is unknown'}.")
    return int(answer)
