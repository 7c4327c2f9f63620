"""The grader's interface to a sandbox worker, a process that runs one part at a time in a sandbox."""

from __future__ import annotations

import os
import selectors
import subprocess
import sys
import tempfile
from pathlib import Path
from types import TracebackType
from typing import IO

from course_pkg.errors import WorkerFailed
from course_pkg.sandbox.isolation import Kind
from course_pkg.sandbox.job import PartJob, PartResult, result_from
from course_pkg.sandbox.linux.bubblewrap import clean_environment, sandbox_command
from course_pkg.setup import Places, environment
from course_pkg.waiting import Deadline

START_TIMEOUT = 90.0  # The worker has to start within this time in s; without load, the start takes 2 s.
# Each part has its own time limit. The worker itself has failed if there is no result after this limit plus
# `SLACK` s.
SLACK = 45.0


class SandboxWorker:
    """A context manager that runs parts of submissions in a worker process.

    After a WorkerFailed error, the next call of `run` starts the worker again.

    The processes in the sandbox end with the thread that made the first call of `run`. `private` is the
    folder with an instructor's private exercises; no submission can read this folder. If `sandboxed` is
    false, student code runs without a sandbox. If `users` is true, student code runs as other users of the
    machine (see users.py).
    """

    def __init__(self, *, sandboxed: bool = True, users: bool = False, private: str = "") -> None:
        self._kind = Kind.USERS if users else Kind.NAMESPACES if sandboxed else Kind.NONE
        self._private = private
        self._process: subprocess.Popen[bytes] | None = None
        self._log: IO[bytes] | None = None
        self._received = b""

    def __enter__(self) -> SandboxWorker:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def run(self, job: PartJob) -> PartResult:
        """Run one part and return its result; raises WorkerFailed if the worker ends or does not respond."""
        process = self._started()
        assert process.stdin is not None
        try:
            process.stdin.write(job.as_json().encode() + b"\n")
            process.stdin.flush()
        except OSError as error:
            raise self._failed("it accepts no jobs") from error
        return result_from(self._line(job.limit + SLACK))

    def kill(self) -> None:
        """Kill the worker; the call of `run` in another thread then raises WorkerFailed."""
        if process := self._process:
            process.kill()

    def close(self) -> None:
        """End the worker and all processes in its sandbox."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.communicate()
        if self._log is not None:
            self._log.close()

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            command = [sys.executable, "-m", "course_pkg.sandbox.worker"]
            command += [self._kind, self._private]
            readable = [Path(self._private)] if self._private else []
            self._log, self._received = tempfile.TemporaryFile(), b""  # noqa: SIM115 -- closed by close()
            self._process = subprocess.Popen(
                sandbox_command(command, readable=readable) if self._kind is Kind.NAMESPACES else command,
                env=self._environment(),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._log,
            )
            self._line(START_TIMEOUT)
        return self._process

    def _environment(self) -> dict[str, str]:
        if self._kind is Kind.NAMESPACES:
            return {}
        return (
            clean_environment() if self._kind is Kind.USERS else environment.merged(Places.of(), os.environ)
        )

    def _line(self, timeout: float) -> bytes:
        """Return the next line that the worker prints."""
        assert self._process is not None
        assert self._process.stdout is not None
        deadline = Deadline(timeout)
        with selectors.DefaultSelector() as selector:
            selector.register(self._process.stdout, selectors.EVENT_READ)
            while b"\n" not in self._received:
                if not selector.select(deadline.left):
                    raise self._failed(f"it did not answer for {timeout:g} s")
                if not (chunk := os.read(self._process.stdout.fileno(), 65536)):
                    raise self._failed("it ended")
                self._received += chunk
        line, _, self._received = self._received.partition(b"\n")
        return line

    def _failed(self, what: str) -> WorkerFailed:
        """End the worker, and return an error with the reason and the last line of the worker's output."""
        assert self._log is not None
        self._log.seek(0)
        last = self._log.read()[-2000:].decode("utf-8", "replace").strip().splitlines()[-1:]
        self.close()
        return WorkerFailed(": ".join([f"The process that runs submissions failed: {what}", *last]))
