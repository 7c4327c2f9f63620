"""Nodes that run as separate processes and end when this process ends."""

from __future__ import annotations

import os
import signal
import tempfile
import weakref
from collections.abc import Callable, Sequence
from contextlib import suppress
from types import TracebackType

from course_pkg.errors import GraphError, NodeFailed
from course_pkg.ros.process.executables import find_executable
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import ask_all, service_probe
from course_pkg.ros.protocol.registrations import registered_at, withdraw
from course_pkg.ros.protocol.xmlrpc import port_of
from course_pkg.waiting import wait_until

TAIL = 2000  # An error message contains at most this many characters of the output.
# This is the time in s between two polls of wait_for_service() and wait_for_output(). Each poll takes some
# milliseconds in this process and in the master.
INTERVAL = 0.05
GRACE = 3.0  # A node has to end within this time in s after SIGINT; a node with rospy takes 0.6 s.


class NodeProcess:
    """A command that runs one or more nodes. The nodes end when this process ends, or earlier.

    A temporary file stores the output of the command. The file is deleted together with this object.
    """

    def __init__(self, command: Sequence[str], *, label: str = "") -> None:
        self.command = tuple(command)
        self.label = label or os.path.basename(command[0])
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- this object needs it all the time
        weakref.finalize(self, self._output.close)
        environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
        self._process = SupervisedProcess(self.command, output=self._output, env=environment)
        self.pid = self._process.pid

    @classmethod
    def rosrun(cls, package: str, executable: str, *args: str, name: str | None = None) -> NodeProcess:
        """Run a package's node, as rosrun does; `name` renames the node.

        Raises UnknownExecutable if there is no such program.
        """
        program = find_executable(package, executable)
        renamed = [f"__name:={name}"] if name else []
        return cls([str(program), *map(str, args), *renamed], label=name or f"{package}/{executable}")

    @classmethod
    def roslaunch(cls, package: str, file: str, *args: str) -> NodeProcess:
        """Run a launch file with arguments such as name:=value.

        When roslaunch ends, all its nodes end.
        """
        return cls(["roslaunch", package, file, *args], label=f"{package}/{file}")

    @property
    def returncode(self) -> int | None:
        """The exit status (negative after a signal), or None while the process is running."""
        return self._process.returncode

    @property
    def running(self) -> bool:
        """Whether the process is running."""
        return self.returncode is None

    def listening_ports(self) -> frozenset[int]:
        """Return the TCP ports on which the process and its descendants listen."""
        return self._process.listening_ports()

    def output(self) -> str:
        """Return all output of the process so far (stdout and stderr)."""
        file = self._output.fileno()
        return os.pread(file, os.fstat(file).st_size, 0).decode("utf-8", "replace")

    def wait_for_service(self, name: str, timeout: float = 30.0) -> None:
        """Return as soon as this process offers the service `name` and accepts connections.

        Raises NodeFailed if the process ends first, or after `timeout` s; the message contains the last
        output.
        """
        full, master = "/" + name.lstrip("/"), MasterClient(master_uri())
        self._wait_until(
            lambda: self._serves(master, full), timeout, f"never served {full}", f"does not serve {full}"
        )

    def wait_for_output(self, text: str, timeout: float = 30.0) -> None:
        """Return as soon as the process has printed the text `text`.

        Raises NodeFailed if the process ends first, or after `timeout` s; the message contains
        the last output.
        """
        self._wait_until(
            lambda: text in self.output(), timeout, f"never printed {text!r}", f"has not printed {text!r}"
        )

    def wait(self, timeout: float = 10.0) -> int:
        """Wait for the end of the process and return its exit status; raises NodeFailed after `timeout` s."""
        self._process.wait(timeout)
        status = self.returncode
        if status is None:
            raise self._failed(f"is still running after {timeout:g} s")
        return status

    def interrupt(self) -> None:
        """Interrupt the process, as Ctrl-C does, and return at once."""
        self._process.signal(signal.SIGCONT)
        self._process.signal(signal.SIGINT)

    def stop(self, grace: float = GRACE, *, unregister: bool = True) -> None:
        """End the process with SIGINT; if it still runs after the time `grace` (s), kill it with SIGKILL.

        If `unregister` is true, also remove the registrations that the process has left at the master.
        """
        if not self.running:
            return
        ports = self._process.listening_ports() if unregister else frozenset()
        self._process.end(grace)
        # A killed node could not unregister itself. The same is true for a node that ended during its
        # registration.
        if registered := registered_at(ports):
            with suppress(GraphError):
                withdraw(MasterClient(master_uri()), registered)

    def kill(self) -> None:
        """End the process with SIGKILL; its registrations remain at the master."""
        self._process.signal(signal.SIGKILL)
        self._process.wait(GRACE)

    def __enter__(self) -> NodeProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.label}, {'running' if self.running else 'ended'}>"

    def _serves(self, master: MasterClient, name: str) -> bool:
        """Return True if this process is the registered server of the service and answers a probe."""
        uri = master.lookup_service(name)
        if uri is None or port_of(uri) not in self._process.listening_ports():
            return False
        probe = service_probe(name, uri)
        ask_all([probe], timeout=1.0)
        return probe.answered

    def _wait_until(self, condition: Callable[[], bool], timeout: float, never: str, not_yet: str) -> None:
        def settled() -> str:
            # A process may print the expected output just before it ends. Therefore, read `running` before
            # the output.
            ended = not self.running
            return "met" if condition() else "ended" if ended else ""

        outcome = wait_until(settled, timeout, INTERVAL)
        if outcome == "ended":
            raise self._failed(f"ended with exit status {self.returncode}, and {never}")
        if outcome != "met":
            raise self._failed(f"is running, but {not_yet} after {timeout:g} s")

    def _failed(self, what: str) -> NodeFailed:
        tail = self.output()[-TAIL:].strip()
        printed = f"The end of the program's output:\n{tail}" if tail else "The program printed nothing."
        return NodeFailed(f"{self.label} {what}. {printed}", tail, self.returncode)
