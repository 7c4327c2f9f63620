"""Messages (JSON texts with optional open files) between the trusted processes of a sandbox worker."""

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

LONGEST = 65536  # A message has at most this number of bytes.


class Message(TypedDict, total=False):
    """A message between the worker, the fork server and a supervisor."""

    ready: bool  # The fork server has imported all modules.
    job: bool  # The worker sends a job.
    supervisor: int  # This is the process id of a supervisor that has started its processes.
    port: int  # The master of the part uses this port.
    # This is the process id of the student's process. The answer runs in the student's process or in one of
    # its descendants.
    student: int
    over: int  # A supervisor and all its descendants have ended; this is the supervisor's wait status.


def pair() -> tuple[socket.socket, socket.socket]:
    """Return the two sockets of a new connection."""
    return socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)


def send(sock: socket.socket, message: Message, descriptors: Sequence[int] = ()) -> None:
    """Send a message together with open file descriptors."""
    socket.send_fds(sock, [json.dumps(message).encode()], descriptors)


def receive(sock: socket.socket, timeout: float | None = None) -> tuple[Message, list[int]]:
    """Return the next message and its open file descriptors.

    Raises EOFError if the connection is closed, and TimeoutError after `timeout` s.
    """
    if not select.select([sock], [], [], timeout)[0]:
        raise TimeoutError(f"no message within {timeout:g} s")
    data, descriptors, _, _ = socket.recv_fds(sock, LONGEST, 4)
    if not data:
        raise EOFError
    return json.loads(data), list(descriptors)


def fork(work: Callable[[], None]) -> int:
    """Run a function in a forked process without standard input and output; return the process id."""
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
    """Exclude all existing objects from garbage collection.

    The garbage collector writes to each object. After each fork, this would copy the memory of all objects.
    Without these copies, a part needs 20 % less CPU time.
    """
    gc.collect()
    gc.freeze()


def descendants(pid: int) -> list[int]:
    """Return the ids of all descendants of the process `pid`, its children first."""
    try:
        return [process.pid for process in psutil.Process(pid).children(recursive=True)]
    except psutil.NoSuchProcess:
        return []


def end_all_below(timeout: float) -> None:
    """Kill all descendants of this process, including newly adopted processes, within `timeout` s."""
    deadline = Deadline(timeout)
    while (left := descendants(os.getpid())) and not deadline.passed:
        end(left)
        with suppress(ChildProcessError):
            os.waitpid(-1, 0)


def end(pids: Sequence[int]) -> None:
    """Kill processes; ignore processes that have already ended."""
    for pid in pids:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
