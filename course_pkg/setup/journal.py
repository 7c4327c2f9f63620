"""Run the tools of the set-up, and store their output in one file."""

from __future__ import annotations

import os
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from course_pkg.errors import SetupError

KEPT_LOGS = 10
TAIL_LINES = 8
WATCH_INTERVAL = 0.5  # This is the time in s between two calls of `watch`.
LEAST_FREE = 1 << 20  # A disk with less free space (in bytes) is treated as full.
FULL = ("No space left on device", "not enough free space")


class Journal:
    """One run of the set-up: its log file, and the lock that its tools inherit."""

    def __init__(self, folder: Path, lock: int) -> None:
        self._lock = lock
        self.path = folder / time.strftime(f"setup-%Y%m%d-%H%M%S-{os.getpid()}.log")
        for old in sorted(folder.glob("setup-*.log"))[: -KEPT_LOGS + 1]:
            old.unlink(missing_ok=True)

    def run(
        self,
        command: Sequence[str | Path],
        *,
        env: Mapping[str, str] | None = None,
        watch: Callable[[str], None] | None = None,
    ) -> None:
        """Run the command `command`, and wait until it ends.

        The function `watch` is called twice per second with the last line of the output. The output goes to a
        file. Therefore, a package manager can finish even after the set-up was killed. The command inherits
        the lock; the next set-up therefore waits until the command has ended.

        Raises SetupError, with the last lines of the output, if the command fails.
        """
        with self.path.open("ab") as log:
            log.write(f"$ {' '.join(map(str, command))}\n".encode())
            log.flush()
            start = log.tell()
            with subprocess.Popen(
                command, env=env, stdin=self._stdin(command), stdout=log, stderr=log, pass_fds=(self._lock,)
            ) as process:
                while True:
                    try:
                        status = process.wait(WATCH_INTERVAL)
                        break
                    except subprocess.TimeoutExpired:
                        if watch:
                            watch("".join(self._tail(start, 1)))
        if status:
            raise self._failure(command, status, start)

    @staticmethod
    def _stdin(command: Sequence[str | Path]) -> int | None:
        return None if command[0] == "sudo" else subprocess.DEVNULL

    def _failure(self, command: Sequence[str | Path], status: int, start: int) -> SetupError:
        lines = self._tail(start, 400)
        if self._is_full() or any(message in line for line in lines for message in FULL):
            return SetupError(
                f"The disk is full ({self.path}). Delete files that you do not need, and start again."
            )
        shown = "\n".join(f"  {line}" for line in lines[-TAIL_LINES:])
        name = " ".join(str(part) for part in command if not str(part).startswith("-"))[:80]
        return SetupError(f"`{name}` ended with status {status}:\n{shown}\nThe whole output: {self.path}")

    def _is_full(self) -> bool:
        """Return whether the cache's disk is full."""
        disk = os.statvfs(self.path)
        return disk.f_bavail * disk.f_frsize < LEAST_FREE

    def _tail(self, start: int, count: int) -> list[str]:
        with self.path.open("rb") as log:
            log.seek(start)
            text = log.read().decode(errors="replace")
        return [line for line in text.replace("\r", "\n").splitlines() if line.strip()][-count:]
