"""Running `course` as a user does, and looking at what it leaves behind."""

from __future__ import annotations

import os
import re
import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.graph.leashed import descendants
from tests.support import eventually

ROOT = Path(__file__).parents[2]
ADDRESS = re.compile(r"http://\S+")


def user_environment() -> dict[str, str]:
    """Return an environment without what the suite itself set."""
    return {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}


@contextmanager
def running(*words: str) -> Iterator[subprocess.Popen[str]]:
    """Start `course` with its output in pipes; end it if it has not ended by itself."""
    with subprocess.Popen(
        [ROOT / "course", *words],
        env=user_environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,  # so that a test's own Ctrl-C does not count twice
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
                process.communicate(timeout=20)


@contextmanager
def lab(*words: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Start `course lab`; yield the process, and the address once it is printed."""
    with running("lab", "--no-browser", *words) as process:
        yield process, address_of(process)


def address_of(process: subprocess.Popen[str]) -> str:
    """Read the output up to the address."""
    seen = []
    assert process.stdout
    for line in process.stdout:
        seen.append(line)
        if found := ADDRESS.search(line):
            return found[0]
    raise AssertionError(f"no address in {seen}")


def below(process: subprocess.Popen[str]) -> list[int]:
    """Return the processes below `process`."""
    return descendants(process.pid)


def all_gone(pids: list[int]) -> bool:
    """Wait until none of `pids` lives."""
    return eventually(lambda: not [pid for pid in pids if alive(pid)], timeout=20)


def alive(pid: int) -> bool:
    """Say whether a process runs; one that is dead and not yet reaped does not."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"
