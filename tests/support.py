"""Functions for all tests: waiting, states of processes, and commands."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TypeVar

import pytest
from _pytest.mark import ParameterSet

Result = TypeVar("Result")


def usual(count: int, cases: Mapping[str, object]) -> list[ParameterSet]:
    """Return parameters for a test, one for each case; all cases after the first `count` are slow tests.

    A key of `cases` is the id of a test. A value is the test's parameter, or a tuple of parameters.
    """
    return [
        pytest.param(
            *(case if isinstance(case, tuple) else (case,)),
            id=name,
            marks=[] if number < count else [pytest.mark.slow],
        )
        for number, (name, case) in enumerate(cases.items())
    ]


def eventually(condition: Callable[[], Result], timeout: float = 10.0, interval: float = 0.01) -> Result:
    """Call a function repeatedly, and return its first true value. Fail after `timeout` s."""
    deadline = time.monotonic() + timeout
    while not (value := condition()):
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {timeout:g} s: {condition}")
        time.sleep(interval)
    return value


@contextmanager
def stopped(pid: int) -> Iterator[None]:
    """Suspend a process with SIGSTOP during the `with` block."""
    os.kill(pid, signal.SIGSTOP)
    try:
        eventually(lambda: all(state in "Tt" for state in _thread_states(pid)))
        yield
    finally:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGCONT)


def process_state(pid: int) -> str:
    """Return the letter with which ps shows the state of a process.

    If the process has exited, return "Z".
    """
    return _state(Path(f"/proc/{pid}/stat"))


def _thread_states(pid: int) -> list[str]:
    return [_state(thread / "stat") for thread in Path(f"/proc/{pid}/task").iterdir()]


def _state(stat: Path) -> str:
    try:
        return stat.read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def terminal(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a command, and return its exit status and output."""
    env = {**os.environ, **environment}
    return subprocess.run(command, capture_output=True, text=True, timeout=30, env=env, check=False)


def program(name: str, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run one of the course's programs, and return its exit status and output."""
    return terminal("rosrun", "course_pkg", name, *arguments, **environment)
