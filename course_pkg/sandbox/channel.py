"""How the trusted processes of a sandbox worker talk: JSON and open files, as whole messages."""

from __future__ import annotations

import gc
import json
import os
import select
import signal
import socket
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TypedDict

import psutil

from course_pkg.waiting import Deadline

LONGEST = 65536  # bytes of a message


class Message(TypedDict, total=False):
    """What the worker, the fork server and a supervisor tell one another."""

    ready: bool  # the fork server has imported everything
    job: bool  # the worker hands over a job
    supervisor: int  # the process id of a supervisor whose processes run
    port: int  # of the part's master
    over: int  # a supervisor's wait status: it and all below it have ended


def pair() -> tuple[socket.socket, socket.socket]:
    """Return the two ends."""
    return socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)


def send(sock: socket.socket, message: Message, descriptors: Sequence[int] = ()) -> None:
    """Send `message` and open files."""
    socket.send_fds(sock, [json.dumps(message).encode()], descriptors)


def receive(sock: socket.socket, timeout: float | None = None) -> tuple[Message, list[int]]:
    """Return the next message and its open files.

    Raises EOFError when the other end has closed, and TimeoutError after `timeout` s.
    """
    if not select.select([sock], [], [], timeout)[0]:
        raise TimeoutError(f"no message within {timeout:g} s")
    data, descriptors, _, _ = socket.recv_fds(sock, LONGEST, 4)
    if not data:
        raise EOFError
    return json.loads(data), list(descriptors)


def fork(work: Callable[[], None]) -> int:
    """Run `work` in a child without standard input and output, and return its process id."""
    if pid := os.fork():
        return pid
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        null = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1):
            os.dup2(null, descriptor)
        work()
    finally:
        os._exit(1)


def share_memory_with_children() -> None:
    """Exclude all present objects from garbage collection, which would copy their memory in every fork.

    This saves a fifth of the processor time of a part.
    """
    gc.collect()
    gc.freeze()


def descendants(pid: int) -> list[int]:
    """Return the processes below `pid`, its children first; none if it has ended."""
    try:
        return [process.pid for process in psutil.Process(pid).children(recursive=True)]
    except psutil.NoSuchProcess:
        return []


def end_all_below(timeout: float) -> None:
    """Kill all processes below this one within `timeout` s, also those that it adopts meanwhile."""
    deadline = Deadline(timeout)
    while (left := descendants(os.getpid())) and not deadline.passed:
        end(left)
        with suppress(ChildProcessError):
            os.waitpid(-1, 0)


def end(pids: Sequence[int]) -> None:
    """Kill processes; it is no error if one has ended already."""
    for pid in pids:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
