"""How the trusted processes of a ward talk: JSON and open files, over a socket that keeps messages apart."""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from course_pkg.graph.leashed import descendants

WORDS = 65536  # bytes of a message


def pair() -> tuple[socket.socket, socket.socket]:
    """Return the two ends."""
    return socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)


def send(sock: socket.socket, words: dict[str, Any], descriptors: Sequence[int] = ()) -> None:
    """Send `words` and open files."""
    socket.send_fds(sock, [json.dumps(words).encode()], descriptors)


def receive(sock: socket.socket, timeout: float | None = None) -> tuple[dict[str, Any], list[int]]:
    """Return the next message and its files; raise EOFError at the end, TimeoutError after `timeout` s."""
    if not select.select([sock], [], [], timeout)[0]:
        raise TimeoutError(f"no word within {timeout:g} s")
    data, descriptors, _, _ = socket.recv_fds(sock, WORDS, 4)
    if not data:
        raise EOFError
    return json.loads(data), list(descriptors)


def fork(work: Callable[[], None]) -> int:
    """Run `work` in a child that hears and prints nothing, and return its pid."""
    if pid := os.fork():
        return pid
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        silence = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1):
            os.dup2(silence, descriptor)
        work()
    finally:
        os._exit(1)


def end_all_below(patience: float) -> None:
    """Kill all processes below this one, those too that their deaths bring here, for at most `patience` s."""
    deadline = time.monotonic() + patience
    while (left := descendants(os.getpid())) and time.monotonic() < deadline:
        end(left)
        with suppress(ChildProcessError):
            os.waitpid(-1, 0)


def end(pids: Sequence[int]) -> None:
    """Kill processes; those that are gone already are no error."""
    for pid in pids:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
