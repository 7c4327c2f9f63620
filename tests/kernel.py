"""Runs code cells in a Python process, as the kernel of a notebook does."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import Any

TIMEOUT = 30.0  # TIMEOUT is the maximum duration of a cell in s; a test can give another limit.

LOOP = """
import json, os, sys, time
replies, names = os.fdopen(int(sys.argv[1]), "w"), {}
del sys.argv[1:]
for line in sys.stdin:
    started = time.monotonic()
    reply = {"value": None, "error": "", "words": ""}
    names.pop("result", None)
    try:
        print("begun", file=replies, flush=True)
        exec(compile(json.loads(line), "cell", "exec"), names)
        reply["value"] = names.get("result")
    except BaseException as error:
        reply["error"], reply["words"] = type(error).__name__, str(error)
    reply["took"] = time.monotonic() - started
    print(json.dumps(reply, default=repr), file=replies, flush=True)
"""


@dataclass(frozen=True)
class Reply:
    """The result of a cell.

    `value` is the value of the variable `result` in the cell. If the cell raised an exception, `error` is the
    exception's class name and `words` is its message. `took` is the duration of the cell in s.
    """

    value: Any
    error: str
    words: str
    took: float


class Kernel:
    """A Python process that runs cells.

    If a cell reaches its time limit, the process is killed, and the test fails with an AssertionError.
    """

    def __init__(self, env: Mapping[str, str | None] | None = None) -> None:
        reader, writer = os.pipe()
        environment = {**os.environ, **(env or {})}
        self._process = subprocess.Popen(
            [sys.executable, "-c", LOOP, str(writer)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=[writer],
            env={name: value for name, value in environment.items() if value is not None},
            start_new_session=True,  # Jupyter also starts each kernel in a new session.
            text=True,
        )
        os.close(writer)
        self._replies = os.fdopen(reader)
        self.pid = self._process.pid

    def __enter__(self) -> Kernel:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.exit()

    def ask(self, cell: str, timeout: float = TIMEOUT) -> Reply:
        """Run a cell, and return its result or error. The time limit is in s."""
        self.begin(cell)
        return self.reply(timeout)

    def run(self, cell: str, timeout: float = TIMEOUT) -> Any:  # noqa: ANN401
        """Run a cell without errors, and return the cell's `result`."""
        reply = self.ask(cell, timeout)
        assert not reply.error, f"{reply.error}: {reply.words}"
        return reply.value

    def begin(self, cell: str) -> None:
        """Start a cell, and return immediately."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(textwrap.dedent(cell)) + "\n")
        self._process.stdin.flush()
        assert self._line(TIMEOUT) == "begun\n"

    def reply(self, timeout: float = TIMEOUT) -> Reply:
        """Return the result of the started cell."""
        return Reply(**json.loads(self._line(timeout)))

    def kill(self) -> None:
        """Kill the process with SIGKILL."""
        self._process.kill()

    def interrupt(self) -> None:
        """Interrupt the running cell: send SIGINT to the kernel's process group, as Jupyter does."""
        os.killpg(self.pid, signal.SIGINT)

    def exit(self, timeout: float = 10.0) -> str:
        """End the process within a time limit (in s), and return its printed text."""
        try:
            printed, _ = self._process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            self._process.kill()
            printed, _ = self._process.communicate()
            raise
        finally:
            self._replies.close()
        return printed

    def _line(self, timeout: float) -> str:
        guard = threading.Timer(timeout, self.kill)
        guard.start()
        try:
            line = self._replies.readline()
        finally:
            guard.cancel()
        assert line, f"the cell did not end within {timeout:g} s, or its process ended before the cell"
        return line

    @property
    def returncode(self) -> int | None:
        """The exit status, or None while the process runs."""
        return self._process.poll()
