"""Kills `course lab`, its master and its kernel by SIGKILL, again and again, and prints what was left behind.

usage: ./course run python tests/bench/kill.py [TIMES]
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from urllib.parse import urlsplit

sys.path.insert(0, str(Path(__file__).parents[2]))

from course_pkg.lab.ports import free_port
from tests.lab.commands import alive, below, lab
from tests.support import eventually

NOTEBOOK = str(next(Path(__file__).parents[2].glob("solutions/*.ipynb")))
KERNEL, MASTER = b"ipykernel_launcher", b"rosmaster\0--core"
PATIENCE = 20.0  # s until what is left counts as left


def main(times: int) -> int:
    """Kill each of the three as often as asked."""
    left = 0
    for name, kill in {"course lab": kill_lab, "the master": kill_master, "the kernel": kill_kernel}.items():
        port = free_port()  # the same for each start: a port that is held makes the next one fail
        seconds, leftovers = zip(*(kill(port) for _ in range(times)), strict=True)
        slowest, count = max(seconds), sum(leftovers)
        print(f"SIGKILL of {name}, {times} times: {count} processes or ports left; slowest {slowest:.1f} s")
        left += sum(leftovers)
    return int(left > 0)


def kill_lab(port: int) -> tuple[float, int]:
    """Kill the command itself."""
    with started(port) as (process, family):
        process.kill()
        return cleared(family, port)


def kill_master(port: int) -> tuple[float, int]:
    """Kill the master, then end the command as a user does."""
    return kill_one(port, MASTER)


def kill_kernel(port: int) -> tuple[float, int]:
    """Kill the kernel, then end the command as a user does."""
    return kill_one(port, KERNEL)


def kill_one(port: int, words: bytes) -> tuple[float, int]:
    """Kill the process with `words` in its command line."""
    with started(port) as (process, family):
        os.kill(having(words, family)[-1], signal.SIGKILL)  # the process itself, before it stands its watcher
        family += below(process)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
        return cleared(family, port)


@contextmanager
def started(port: int) -> Iterator[tuple]:  # type: ignore[type-arg]
    """Start `course lab` and wait for its kernel; yield the process, and all below it."""
    with lab("--port", str(port), NOTEBOOK) as (process, address):
        assert urlsplit(address).port == port
        # The address is there before the kernel is: what a page asks meanwhile waits.
        yield process, eventually(lambda: with_kernel(below(process)))


def with_kernel(family: list[int]) -> list[int]:
    """Return `family` if the kernel and the master are in it, else nothing."""
    return family if having(KERNEL, family) and having(MASTER, family) else []


def having(words: bytes, family: list[int]) -> list[int]:
    """Return those in whose command line `words` stand."""
    found = []
    for pid in family:
        with suppress(OSError):  # it has ended meanwhile
            if words in Path(f"/proc/{pid}/cmdline").read_bytes():
                found.append(pid)
    return found


def cleared(family: list[int], port: int) -> tuple[float, int]:
    """Wait until no process and no port is left; return the seconds, and how many are."""
    begun = time.monotonic()
    looks: list[Callable[[], int]] = [lambda: sum(map(alive, family)), lambda: held(port)]
    while (left := sum(look() for look in looks)) and time.monotonic() - begun < PATIENCE:
        time.sleep(0.02)
    return time.monotonic() - begun, left


def held(port: int) -> int:
    """Return 1 if anybody listens on `port`, else 0."""
    with socket.socket() as client:
        return int(client.connect_ex(("127.0.0.1", port)) == 0)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 20))
