"""Functions that run `course` as a user does, and functions that find running processes."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from course_pkg.ros.process.supervisor import descendants
from tests.support import eventually

ROOT = Path(__file__).parents[2]
ADDRESS = re.compile(r"https?://\S+")


def user_environment() -> dict[str, str]:
    """Return the environment without the test suite's ROS variables."""
    return {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}


@contextmanager
def running(*arguments: str, before: Sequence[str] = (), **variables: str) -> Iterator[subprocess.Popen[str]]:
    """Run `course lab` or `course run` during the `with` block.

    `before` contains the words of the command line that come before `course`.
    """
    with subprocess.Popen(
        [*before, ROOT / "course", *arguments],
        env={**user_environment(), **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        # In a new session, the process does not receive the Ctrl-C that stops the tests.
        start_new_session=True,
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
                process.communicate(timeout=20)


@contextmanager
def lab(*arguments: str, **variables: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Start `course lab`, and yield the process and the printed address."""
    with running("lab", "--no-browser", *arguments, **variables) as process:
        yield process, address_of(process)


def address_of(process: subprocess.Popen[str]) -> str:
    """Read the output until the line with the address, and return the address."""
    seen = []
    assert process.stdout
    for line in process.stdout:
        seen.append(line)
        if found := ADDRESS.search(line):
            return found[0]
    raise AssertionError(f"no address in {seen}")


def below(process: subprocess.Popen[str]) -> list[int]:
    """Return all descendants of a process."""
    return descendants(process.pid)


def all_gone(pids: list[int]) -> bool:
    """Wait up to 20 s, and return whether all given processes have exited."""
    return eventually(lambda: not [pid for pid in pids if alive(pid)], timeout=20)


def alive(pid: int) -> bool:
    """Return whether a process runs; a zombie does not count as running."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def having(pattern: bytes, pids: list[int]) -> list[int]:
    """Return each given process that has the pattern in its command line."""
    found = []
    for pid in pids:
        with suppress(OSError):  # The process may have exited.
            if pattern in Path(f"/proc/{pid}/cmdline").read_bytes():
                found.append(pid)
    return found


def network_of(pid: int) -> list[str]:
    """Return the first words of a command line that runs a command in the network of a process."""
    other = [kind for kind in ("user", "net") if os.readlink(f"/proc/{pid}/ns/{kind}") != own_namespace(kind)]
    return ["nsenter", "-t", str(pid), *(f"--{kind}" for kind in other), "--preserve-credentials", "--"]


def own_namespace(kind: str) -> str:
    """Return the identifier of a namespace of the current process; the argument is a type such as net."""
    return os.readlink(f"/proc/self/ns/{kind}")


def network_namespace(pid: int) -> str:
    """Return the network namespace of a process, or "" if the process has ended."""
    try:
        return os.readlink(f"/proc/{pid}/ns/net")
    except OSError:
        return ""


def listening(pids: list[int]) -> set[tuple[str, int]]:
    """Return the IPv4 addresses and ports on which the processes listen, in any network namespace."""
    found = set()
    for pid in pids:
        with suppress(OSError):  # The process may have ended.
            files = {os.readlink(file) for file in Path(f"/proc/{pid}/fd").iterdir()}
            for line in Path(f"/proc/{pid}/net/tcp").read_text().splitlines()[1:]:
                words = line.split()
                if words[3] == "0A" and f"socket:[{words[9]}]" in files:
                    host, port = words[1].split(":")
                    found.add((socket.inet_ntoa(bytes.fromhex(host)[::-1]), int(port, 16)))
    return found


def can_connect(port: int) -> bool:
    """Return whether a program listens on a port of this host."""
    with socket.socket() as client:
        return client.connect_ex(("127.0.0.1", port)) == 0
