"""Starting a command so that it, and whatever it starts, ends with its owner.

The command runs below `leashed.py`, a small process that watches the owner and outlives it
for as long as it takes to clear up. That holds also when the owner is killed by SIGKILL.
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

PROGRAM = Path(__file__).with_name("leashed.py")


class Leash:
    """A command and its descendants, held by this process.

    `command` may be empty: then there is nothing to hold, and only the last will is carried out when this
    process is gone. The last will: `remove`, a folder to delete; `forget`, a (master's URI, node's name,
    node's URI) whose registrations to withdraw. `inherit` are descriptors that the command gets.
    """

    def __init__(
        self,
        command: Sequence[str],
        *,
        output: IO[bytes] | int = subprocess.DEVNULL,
        env: Mapping[str, str] | None = None,
        remove: Path | None = None,
        forget: tuple[str, str, str] | None = None,
        inherit: Sequence[int] = (),
    ) -> None:
        self._owner = os.getpid()
        reader, writer = os.pipe()
        try:
            self._process = subprocess.Popen(
                _program(writer, remove, forget) + list(command),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                env=env,
                pass_fds=[writer, *inherit],
                start_new_session=True,  # an interrupt of the kernel goes to its process group
            )
        finally:
            os.close(writer)
        self.pid = _started(reader, command, self._process)

    @property
    def returncode(self) -> int | None:
        """The exit status of the command, negative for a signal, or None while anything below it lives."""
        status = self._process.poll()
        return 128 - status if status is not None and status > 128 else status

    def signal(self, number: int) -> None:
        """Send a signal to the command; one that is gone already is no error."""
        if self.returncode is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def wait(self, timeout: float) -> bool:
        """Return whether everything below is gone, at the latest after `timeout` s."""
        try:
            self._process.wait(timeout)
        except subprocess.TimeoutExpired:
            return False
        return True

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


def _program(report: int, remove: Path | None, forget: tuple[str, str, str] | None) -> list[str]:
    will = [str(remove or ""), *(forget or ("", "", ""))]
    # Isolated and without site: it starts in 20 ms, and nothing on the student's path can break it.
    return [sys.executable, "-I", "-S", str(PROGRAM), str(os.getpid()), str(report), *will]


def _started(reader: int, command: Sequence[str], process: subprocess.Popen[bytes]) -> int:
    """Return the command's process id, which the leash tells as soon as the command is running."""
    with os.fdopen(reader) as report:
        answer = report.read()
    if not command:
        return process.pid
    if not answer.isdigit():
        process.wait()
        raise GraphError(f"{command[0]} could not be started: {answer or 'no reason was given'}.")
    return int(answer)
