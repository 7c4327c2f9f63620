"""A short program of a case as a process: started early, begun when it is wanted, watched for a while."""

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
from course_pkg.graph.leash import Leash
from course_pkg.graph.ports import family, listening_ports

PLAYER = Path(__file__).with_name("player.py")
READY = 15.0  # s for an interpreter and rospy; it takes 0.3 s
LONGEST = 8000  # characters of an output that are kept, from its end
LOOK = 0.01  # s between looks
_FOR_A_TERMINAL = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\a]*\a")  # colours, and the title of its window


@dataclass(frozen=True)
class Seen:
    """What was seen of a program: its text, what it printed, how long that took (s), its exit status.

    `status` is None for one that was still waiting when the watch ended, negative for a signal.
    """

    shown: str
    said: str
    seconds: float
    status: int | None

    @property
    def waiting(self) -> bool:
        """Whether it had not come to its end."""
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
        self._leash = self._started(command, {**env, "PYTHONUNBUFFERED": "1"})
        self.pid = self._leash.pid

    @classmethod
    def python(cls, name: str, code: str, env: Mapping[str, str], *args: str) -> Program:
        """Have `code` run as the file `name`, once it is begun."""
        return cls(code, [sys.executable, str(PLAYER), "READY", "GO", name, code, *args], env)

    def begin(self) -> None:
        """Let a text begin, as soon as its interpreter is there. Raises NodeFailed when that ends first."""
        if self._pipes:
            self._await_byte(READY)
            self._ready = True
            os.write(self._pipes[1], b"g")
            self._began = time.monotonic()

    def watch(self, patience: float) -> Seen:
        """Return what is seen of it until it ends, or after `patience` s from its beginning."""
        while not self.over and time.monotonic() < self._began + patience:
            time.sleep(LOOK)
        took = time.monotonic() - self._began
        return Seen(self.shown, self.output(), took, self._status)

    @property
    def over(self) -> bool:
        """Whether its text has come to its end, or its process has."""
        if self._status is None:
            if self._ready and select.select([self._pipes[0]], [], [], 0)[0]:
                end = os.read(self._pipes[0], 1)
                self._status = end[0] if end else self._ended_with()
            else:
                self._status = self._leash.returncode
        return self._status is not None

    @property
    def running(self) -> bool:
        """Whether its process is there."""
        return self._leash.returncode is None

    def output(self) -> str:
        """Return what it has printed so far, at most its last 8000 characters."""
        file = self._output.fileno()
        size = os.fstat(file).st_size
        text = os.pread(file, LONGEST, max(size - LONGEST, 0)).decode("utf-8", "replace")
        return _FOR_A_TERMINAL.sub("", text)

    def ports(self) -> frozenset[int] | None:
        """Return the ports on which it listens, None where the system does not tell."""
        return listening_ports(family(self.pid))

    def signal(self, number: int) -> None:
        """Send it a signal."""
        self._leash.signal(number)

    def kill(self) -> None:
        """Kill it by SIGKILL: it cannot sign off, and what it registered stays."""
        self._leash.signal(signal.SIGKILL)
        self._leash.wait(3.0)

    def freeze(self) -> None:
        """Stop it by SIGSTOP, and return when all its threads stand still."""
        self._leash.signal(signal.SIGSTOP)
        deadline = time.monotonic() + 3.0
        while not _still(self.pid) and time.monotonic() < deadline:
            time.sleep(LOOK)

    def end(self) -> None:
        """End it at once, and whatever it started; a second end changes nothing."""
        if self.running:
            self._leash.end(grace=0)
        _close(self._pipes)

    def _started(self, command: Sequence[str], env: Mapping[str, str]) -> Leash:
        if "READY" not in command:
            return Leash(command, output=self._output, env=env)
        reader, ready = os.pipe()
        go, writer = os.pipe()
        self._pipes += [reader, writer]
        try:
            words = [{"READY": str(ready), "GO": str(go)}.get(word, word) for word in command]
            return Leash(words, output=self._output, env=env, inherit=[ready, go])
        finally:
            os.close(ready)
            os.close(go)

    def _await_byte(self, patience: float) -> None:
        if not select.select([self._pipes[0]], [], [], patience)[0] or not os.read(self._pipes[0], 1):
            raise NodeFailed(f"A program of the lab did not start. What it printed: {self.output()}")

    def _ended_with(self) -> int:
        self._leash.wait(3.0)
        status = self._leash.returncode
        return 0 if status is None else status


def _still(pid: int) -> bool:
    """Whether all threads of a process are stopped; where there is no /proc, it is taken for granted."""
    try:
        stats = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/stat")]
    except OSError:
        return True
    return all(stat.rpartition(")")[2].split()[0] in "Tt" for stat in stats)


def _close(pipes: list[int]) -> None:
    while pipes:
        os.close(pipes.pop())
