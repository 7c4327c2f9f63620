"""A ward as the grader sees it: a process behind walls that is given parts, one at a time."""

from __future__ import annotations

import json
import os
import selectors
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from types import TracebackType
from typing import IO

from course_pkg.errors import WardFailed
from course_pkg.grading.walls import enclosed
from course_pkg.grading.ward.job import PartJob, PartOutcome, outcome_from
from course_pkg.provision import Places, environment

STARTING = 90.0  # s; a machine at rest takes two
SLACK = 45.0  # s beyond a part's own limit until the ward itself is given up


class Ward:
    """Runs parts; a context manager. After WardFailed it starts anew with the next part.

    What stands behind the wall ends with the thread that gave it its first part. `private` is the folder of
    an instructor's extras, which no submission sees.
    """

    def __init__(self, *, walls: bool = True, private: str = "") -> None:
        self._walls = walls
        self._private = private
        self._process: subprocess.Popen[bytes] | None = None
        self._log: IO[bytes] | None = None
        self._heard = b""

    def __enter__(self) -> Ward:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def run(self, job: PartJob) -> PartOutcome:
        """Run one part to its end; raise WardFailed when the ward itself gives no answer."""
        process = self._started()
        assert process.stdin is not None
        try:
            process.stdin.write(json.dumps(job.as_dict()).encode() + b"\n")
            process.stdin.flush()
        except OSError as error:
            raise self._failed("it takes no work") from error
        return outcome_from(json.loads(self._line(job.limit + SLACK)))

    def close(self) -> None:
        """End the ward, and all behind its wall."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.communicate()
        if self._log is not None:
            self._log.close()

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            command = [sys.executable, "-m", "course_pkg.grading.ward.main"]
            command += ["walls" if self._walls else "none", self._private]
            readable = [Path(self._private)] if self._private else []
            self._log, self._heard = tempfile.TemporaryFile(), b""  # noqa: SIM115 -- closed by close()
            self._process = subprocess.Popen(
                enclosed(command, readable=readable) if self._walls else command,
                env={} if self._walls else environment.merged(Places.of(), os.environ),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._log,
            )
            self._line(STARTING)
        return self._process

    def _line(self, timeout: float) -> bytes:
        """Return the next line that the ward says."""
        assert self._process is not None
        assert self._process.stdout is not None
        deadline = time.monotonic() + timeout
        with selectors.DefaultSelector() as selector:
            selector.register(self._process.stdout, selectors.EVENT_READ)
            while b"\n" not in self._heard:
                if not selector.select(max(deadline - time.monotonic(), 0.0)):
                    raise self._failed(f"it said nothing for {timeout:g} s")
                if not (chunk := os.read(self._process.stdout.fileno(), 65536)):
                    raise self._failed("it came to an end")
                self._heard += chunk
        line, _, self._heard = self._heard.partition(b"\n")
        return line

    def _failed(self, what: str) -> WardFailed:
        """End the ward and return the error that says how it failed."""
        assert self._log is not None
        self._log.seek(0)
        last = self._log.read()[-2000:].decode("utf-8", "replace").strip().splitlines()[-1:]
        self.close()
        return WardFailed(": ".join([f"The process that runs submissions failed, {what}", *last]))
