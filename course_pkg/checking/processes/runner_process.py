"""The process of a check runner that a notebook has started.

The process stores the result in the student's own record. If the student shares results, the process also
stores the result for the class view.
"""

from __future__ import annotations

import os
import select
import signal
import socket
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress

from course_pkg.checking.channel import Channel
from course_pkg.checking.processes.runner import run_check
from course_pkg.checking.record import StudentRecord
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.sharing.notice import address
from course_pkg.sharing.outbox import Outbox


class RunnerStopped(BaseException):
    """The kernel has ended, or this process has received SIGTERM."""


def main() -> None:
    """Run one check, and exit at once; the first argument is the file descriptor of the socket."""
    channel = Channel(socket.socket(fileno=int(sys.argv[1])))
    with suppress(RunnerStopped), _stopped_by(channel):
        run_check(channel, _store, kernel=os.getppid)
    sys.stderr.flush()
    os._exit(0)  # Skip rospy's shutdown, which sleeps for 0.6 s; the node is already unregistered.


def _store(check: str, result: Mapping[str, Json]) -> str:
    """Store a result; return a message about problems, or ""."""
    messages = [StudentRecord().store(check, result), Outbox().put(result) if address() else ""]
    return " ".join(filter(None, messages))


@contextmanager
def _stopped_by(channel: Channel) -> Iterator[None]:
    """Raise RunnerStopped in the main thread when the kernel closes `channel`, or after SIGTERM."""

    def stop(*_: object) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # A second signal would interrupt the clean-up.
        raise RunnerStopped

    signal.signal(signal.SIGTERM, stop)
    over = threading.Event()
    threading.Thread(target=_watch, args=(channel.fileno(), over), daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _watch(descriptor: int, over: threading.Event) -> None:
    poll = select.poll()
    poll.register(descriptor, getattr(select, "POLLRDHUP", 0))
    while not over.is_set():
        if poll.poll(200):
            if not over.is_set():
                os.kill(os.getpid(), signal.SIGTERM)
            return
