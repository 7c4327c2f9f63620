"""A short program of a case as a process: started early, released by begin(), watched for a limited time."""

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
READY = 15.0  # s for an interpreter and rospy; it takes 0.3 s
LONGEST = 8000  # bytes of an output that are shown, from its end
INTERVAL = 0.01  # s between polls
_FOR_A_TERMINAL = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\a]*\a")  # colours, and the title of its window


@dataclass(frozen=True)
class Seen:
    """What a program showed: its text, what it printed, how long that took (s), its exit status.

    `status` is None if it was still waiting when the time limit was over, negative for a signal.
    """

    shown: str
    said: str
    seconds: float
    status: int | None

    @property
    def waiting(self) -> bool:
        """Whether it had not ended."""
        return self.status is None

    @property
    def verdict(self) -> str:
        """How it ended, in a few words."""
        if self.status is None:
            return f"no answer within {self.seconds:.0f} s; still waiting"
        end = "ended" if self.status == 0 else f"ended with status {self.status}"
        return f"{end} after {self.seconds:.2f} s"


class Program:
    """A Python text or a command, in a process that ends with this one at the latest.

    A text waits for begin(); a command begins at once.
    """

    def __init__(self, shown: str, command: Sequence[str], env: Mapping[str, str]) -> None:
        self.shown = shown
        self._began = time.monotonic()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it lives as long as this object
        self._pipes: list[int] = []
        weakref.finalize(self, _close, self._pipes)
        weakref.finalize(self, self._output.close)
        self._status: int | None = None
        self._ready = False
        self._process = self._started(command, {**env, "PYTHONUNBUFFERED": "1"})
        self.pid = self._process.pid

    @classmethod
    def python(cls, name: str, code: str, env: Mapping[str, str], *args: str) -> Program:
        """Return a program that runs `code` as the file `name` after begin()."""
        return cls(code, [sys.executable, str(PLAYER), "READY", "GO", name, code, *args], env)

    def begin(self) -> None:
        """Let a text begin, as soon as its interpreter has started. Raises NodeFailed if that ends."""
        if self._pipes:
            self._await_byte(READY)
            self._ready = True
            os.write(self._pipes[1], b"g")
            self._began = time.monotonic()

    def watch(self, timeout: float) -> Seen:
        """Return what it shows until it ends, or until `timeout` s after its beginning."""
        wait_until(lambda: self.over, self._began + timeout - time.monotonic(), INTERVAL)
        took = time.monotonic() - self._began
        return Seen(self.shown, self.output(), took, self._status)

    @property
    def over(self) -> bool:
        """Whether its text, or its process, has ended."""
        if self._status is None:
            if self._ready and select.select([self._pipes[0]], [], [], 0)[0]:
                end = os.read(self._pipes[0], 1)
                self._status = end[0] if end else self._ended_with()
            else:
                self._status = self._process.returncode
        return self._status is not None

    @property
    def running(self) -> bool:
        """Whether its process lives."""
        return self._process.returncode is None

    def output(self) -> str:
        """Return what it has printed so far, at most its last 8000 characters."""
        file = self._output.fileno()
        size = os.fstat(file).st_size
        text = os.pread(file, LONGEST, max(size - LONGEST, 0)).decode("utf-8", "replace")
        return _FOR_A_TERMINAL.sub("", text)

    def ports(self) -> frozenset[int]:
        """Return the ports on which it listens."""
        return self._process.listening_ports()

    def signal(self, number: int) -> None:
        """Send it a signal."""
        self._process.signal(number)

    def kill(self) -> None:
        """Kill it by SIGKILL: it cannot unregister, and what it registered stays."""
        self._process.signal(signal.SIGKILL)
        self._process.wait(3.0)

    def freeze(self) -> None:
        """Stop it by SIGSTOP, and return when all its threads are stopped."""
        self._process.signal(signal.SIGSTOP)
        wait_until(lambda: _still(self.pid), 3.0, INTERVAL)

    def end(self) -> None:
        """End it at once, with all processes that it started; a second end changes nothing."""
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
            raise NodeFailed(f"A program of the lab did not start. What it printed: {self.output()}")

    def _ended_with(self) -> int:
        self._process.wait(3.0)
        status = self._process.returncode
        return 0 if status is None else status


def _still(pid: int) -> bool:
    """Return whether all threads of a process are stopped; psutil tells the state of the process only."""
    try:
        stats = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/stat")]
    except OSError:
        return True
    return all(stat.rpartition(")")[2].split()[0] in "Tt" for stat in stats)


def _close(pipes: list[int]) -> None:
    while pipes:
        os.close(pipes.pop())
