"""The kernel uses this module to start a topic process, send commands to it, and receive reports."""

from __future__ import annotations

import os
import socket
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TypeAlias

import course_pkg
from course_pkg.errors import ChannelClosed, GraphError
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.json_channel import Json, JsonChannel
from course_pkg.ros.protocol.master_api import master_uri
from course_pkg.ros.protocol.registrations import remove_stale
from course_pkg.types import Plain

Report: TypeAlias = dict[str, Json]

TAIL = 600  # An error message contains at most this number of characters of the process's output.
GRACE = 6.0  # Wait up to this time in s for the end of the process; it may still be importing rospy.
# After the end of a killed node, a busy master may still process its registration. This process therefore
# unregisters the node several times.
PAUSES = (0.0, 0.5, 2.0)  # Each number is the time in s before an attempt to unregister the node.


class TopicProcess:
    """A separate node on the topic `topic`; it ends when end() is called, or when this process ends.

    The function `reported` is called with this object and each report. The function `lost` is called with
    this object and an error message if the node ends without end(). `reported` and `lost` are called on
    another thread.

    `main.py` lists the commands, and `reports.py` lists the keys of a report.
    """

    def __init__(
        self,
        topic: str,
        reported: Callable[[TopicProcess, Report], None],
        lost: Callable[[TopicProcess, str], None],
    ) -> None:
        self.topic = topic
        self.master = master_uri()
        self._reported = reported
        self._lost = lost
        self._ended = threading.Event()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it is needed until the process ends
        ours, theirs = socket.socketpair()
        self._channel = JsonChannel(ours)
        with theirs:
            command = [sys.executable, "-m", "course_pkg.ros.topic.main", str(theirs.fileno()), topic]
            self._process = SupervisedProcess(
                command, output=self._output, env=_environment(), inherit=[theirs.fileno()]
            )
        self.pid = self._process.pid
        threading.Thread(target=self._receive, daemon=True, name="topic-reports").start()

    def tell(self, do: str, **what: Plain) -> None:
        """Send the command `do`; do nothing if the process has ended."""
        with suppress(ChannelClosed):  # _receive() reports a closed channel.
            self._channel.send({"do": do, **what})

    def end(self, *, wait: bool = False) -> None:
        """Make the process unregister and end; if `wait` is true, wait until the process has ended."""
        if not self._ended.is_set():
            self._ended.set()
            self._channel.close()
            ending = threading.Thread(target=self._finish, name="topic-end")
            ending.start()
            if wait:
                ending.join()

    def _receive(self) -> None:
        try:
            while True:
                report = self._channel.receive()
                if report is not None and not self._ended.is_set():
                    self._reported(self, report)
        except ChannelClosed:
            if not self._ended.is_set():
                message = f"The panel's node has ended. {self._tail()}"
                self.end()
                self._withdraw()
                self._lost(self, message)

    def _finish(self) -> None:
        if not self._process.wait(GRACE):
            self._process.end(0.2)
            for pause in PAUSES:
                time.sleep(pause)
                self._withdraw()
        self._output.close()

    def _withdraw(self) -> None:
        """Unregister a node that was killed."""
        with suppress(GraphError):
            remove_stale(self.master, nodes=frozenset({f"/topic_panel_{self.pid}"}))

    def _tail(self) -> str:
        descriptor = self._output.fileno()
        text = os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode("utf-8", "replace").strip()
        return f"The end of the node's output:\n{text[-TAIL:]}" if text else "The node printed nothing."


def _environment() -> dict[str, str]:
    """Return an environment in which Python does not import from the current folder.

    Otherwise, a file in the notebook's folder could replace a module of the course.
    """
    here = os.getcwd()
    course = str(Path(course_pkg.__file__).resolve().parent.parent)
    path = [entry for entry in sys.path if entry and os.path.abspath(entry) != here] + [course]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path), "PYTHONSAFEPATH": "1"}
