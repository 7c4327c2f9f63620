"""Run a short program for a fault in a separate process.

The process starts early, and runs the program after begin().
"""

from __future__ import annotations

import os
import re
import select
import signal
import sys
import tempfile
import time
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import NodeFailed
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.waiting import wait_until

PLAYER = Path(__file__).with_name("player.py")
READY = 15.0  # An interpreter has to start and import rospy within this time in s; the usual time is 0.3 s.
LONGEST = 8000  # Only the last `LONGEST` bytes of an output are shown.
INTERVAL = 0.01  # The course polls the state of a process after each pause of this time in s.
# The pattern matches a terminal's escape codes for colours and for the window title.
_FOR_A_TERMINAL = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\a]*\a")


@dataclass(frozen=True)
class Seen:
    """The result of a program: its code or command, its output, its running time in s, and its exit status.

    `status` is None if the program was still running at the time limit, and negative if a signal ended the
    program.
    """

    shown: str
    said: str
    seconds: float
    status: int | None

    @property
    def waiting(self) -> bool:
        """Whether the program reached its time limit."""
        return self.status is None

    @property
    def verdict(self) -> str:
        """A short text that says how the program ended, or that it is still running."""
        if self.status is None:
            return f"no answer within {self.seconds:.0f} s; still waiting"
        end = "ended" if self.status == 0 else f"ended with status {self.status}"
        return f"{end} after {self.seconds:.2f} s"


class Program:
    """A Python program or a command in a separate process.

    When the current process ends, the program's process also ends.

    A Python program waits for begin(); a command begins at once.
    """

    def __init__(self, shown: str, command: Sequence[str], env: Mapping[str, str]) -> None:
        self.shown = shown
        self._began = time.monotonic()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- open as long as this object exists
        self._pipes: list[int] = []
        weakref.finalize(self, _close, self._pipes)
        weakref.finalize(self, self._output.close)
        self._status: int | None = None
        self._ready = False
        self._process = self._started(command, {**env, "PYTHONUNBUFFERED": "1"})
        self.pid = self._process.pid

    @classmethod
    def python(cls, name: str, code: str, env: Mapping[str, str], *args: str) -> Program:
        """Return a program that runs `code` as the file `name` after begin() is called."""
        return cls(code, [sys.executable, str(PLAYER), "READY", "GO", name, code, *args], env)

    def begin(self) -> None:
        """Run the code of a Python program, after its interpreter has started.

        Raises NodeFailed if the interpreter ends, or does not start within `READY` s.
        """
        if self._pipes:
            self._await_byte(READY)
            self._ready = True
            os.write(self._pipes[1], b"g")
            self._began = time.monotonic()

    def watch(self, timeout: float) -> Seen:
        """Wait until the program ends, or for at most `timeout` s; return its result."""
        wait_until(lambda: self.over, self._began + timeout - time.monotonic(), INTERVAL)
        took = time.monotonic() - self._began
        return Seen(self.shown, self.output(), took, self._status)

    @property
    def over(self) -> bool:
        """Whether the code of the program, or its process, has ended."""
        if self._status is None:
            if self._ready and select.select([self._pipes[0]], [], [], 0)[0]:
                end = os.read(self._pipes[0], 1)
                self._status = end[0] if end else self._ended_with()
            else:
                self._status = self._process.returncode
        return self._status is not None

    @property
    def running(self) -> bool:
        """Whether the program's process still exists."""
        return self._process.returncode is None

    def output(self) -> str:
        """Return the program's output so far, at most its last 8000 bytes."""
        file = self._output.fileno()
        size = os.fstat(file).st_size
        text = os.pread(file, LONGEST, max(size - LONGEST, 0)).decode("utf-8", "replace")
        return _FOR_A_TERMINAL.sub("", text)

    def ports(self) -> frozenset[int]:
        """Return the ports on which the program listens."""
        return self._process.listening_ports()

    def signal(self, number: int) -> None:
        """Send a signal to the program."""
        self._process.signal(number)

    def kill(self) -> None:
        """Kill the program with SIGKILL; its registrations remain at the master."""
        self._process.signal(signal.SIGKILL)
        self._process.wait(3.0)

    def freeze(self) -> None:
        """Suspend the program with SIGSTOP, and wait until all its threads are suspended."""
        self._process.signal(signal.SIGSTOP)
        wait_until(lambda: _still(self.pid), 3.0, INTERVAL)

    def end(self) -> None:
        """End the program and all its child processes at once; a second call has no effect."""
        if self.running:
            self._process.end(grace=0)
        _close(self._pipes)

    def _started(self, command: Sequence[str], env: Mapping[str, str]) -> SupervisedProcess:
        if "READY" not in command:
            return SupervisedProcess(command, output=self._output, env=env)
        reader, ready = os.pipe()
        go, writer = os.pipe()
        self._pipes += [reader, writer]
        try:
            line = [{"READY": str(ready), "GO": str(go)}.get(word, word) for word in command]
            return SupervisedProcess(line, output=self._output, env=env, inherit=[ready, go])
        finally:
            os.close(ready)
            os.close(go)

    def _await_byte(self, timeout: float) -> None:
        if not select.select([self._pipes[0]], [], [], timeout)[0] or not os.read(self._pipes[0], 1):
            raise NodeFailed(f"A program of the case did not start. Its output was: {self.output()}")

    def _ended_with(self) -> int:
        self._process.wait(3.0)
        status = self._process.returncode
        return 0 if status is None else status


def _still(pid: int) -> bool:
    """Return whether all threads of a process are suspended.

    The states of the threads are read from /proc, because psutil returns only one state for the whole
    process.
    """
    try:
        stats = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/stat")]
    except OSError:
        return True
    return all(stat.rpartition(")")[2].split()[0] in "Tt" for stat in stats)


def _close(pipes: list[int]) -> None:
    while pipes:
        os.close(pipes.pop())
