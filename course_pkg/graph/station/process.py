"""A station, from the side of the process that wants one."""

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
from typing import Any

import course_pkg
from course_pkg.errors import GraphError
from course_pkg.graph.leash import Leash
from course_pkg.graph.master import master_uri
from course_pkg.graph.stale import remove_stale
from course_pkg.graph.station.wire import Wire

TAIL = 600  # characters of what it printed, in an error message
GRACE = 6.0  # s to sign off: a slow machine may only just be importing rospy
# What a killed node said last may reach a busy master after its death. Hence more than one look.
LOOKS = (0.0, 0.5, 2.0)  # s before each


class TopicStation:
    """A node of its own on `topic`, which ends with end(), and with this process at the latest.

    `heard` gets each report, `lost` a sentence when the node ends though nobody has asked it to; both get
    this object, too, and run on a thread.
    """

    def __init__(
        self,
        topic: str,
        heard: Callable[[TopicStation, dict[str, Any]], None],
        lost: Callable[[TopicStation, str], None],
    ) -> None:
        self.topic = topic
        self.master = master_uri()
        self._heard = heard
        self._lost = lost
        self._ended = threading.Event()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it lives as long as the process
        ours, theirs = socket.socketpair()
        self._wire = Wire(ours)
        with theirs:
            command = [sys.executable, "-m", __name__.replace("process", "main"), str(theirs.fileno()), topic]
            self._leash = Leash(command, output=self._output, env=_environment(), inherit=[theirs.fileno()])
        self.pid = self._leash.pid
        threading.Thread(target=self._listen, daemon=True, name="station-reports").start()

    def tell(self, do: str, **what: Any) -> None:  # noqa: ANN401 -- plain data
        """Tell it to do something; one that is gone is told nothing."""
        with suppress(EOFError):  # _listen says so
            self._wire.send({"do": do, **what})

    def end(self, *, wait: bool = False) -> None:
        """Have it sign off and end; with `wait`, return when it has."""
        if not self._ended.is_set():
            self._ended.set()
            self._wire.close()
            ending = threading.Thread(target=self._finish, name="station-end")
            ending.start()
            if wait:
                ending.join()

    def _listen(self) -> None:
        try:
            while True:
                report = self._wire.receive()
                if report is not None and not self._ended.is_set():
                    self._heard(self, report)
        except EOFError:
            if not self._ended.is_set():
                words = f"The panel's node has ended. {self._tail()}"
                self.end()
                self._forget()
                self._lost(self, words)

    def _finish(self) -> None:
        if not self._leash.wait(GRACE):
            self._leash.end(0.2)
            for pause in LOOKS:
                time.sleep(pause)
                self._forget()
        self._output.close()

    def _forget(self) -> None:
        """Sign off in the place of a node that was killed."""
        with suppress(GraphError):
            remove_stale(self.master, nodes=frozenset({f"/topic_panel_{self.pid}"}))

    def _tail(self) -> str:
        descriptor = self._output.fileno()
        text = os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode("utf-8", "replace").strip()
        return f"The end of what it printed:\n{text[-TAIL:]}" if text else "It printed nothing."


def _environment() -> dict[str, str]:
    """Return an environment in which it finds the course and the workspace, and no file of the notebook's."""
    here = os.getcwd()
    course = str(Path(course_pkg.__file__).resolve().parent.parent)
    path = [entry for entry in sys.path if entry and os.path.abspath(entry) != here] + [course]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path), "PYTHONSAFEPATH": "1"}
