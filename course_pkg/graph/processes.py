"""Nodes that run as processes of their own, held by this one."""

from __future__ import annotations

import os
import signal
import tempfile
import time
import weakref
from collections.abc import Sequence
from types import TracebackType

from course_pkg.errors import NodeFailed
from course_pkg.graph.estate import registered_at, take_back
from course_pkg.graph.executables import find_executable
from course_pkg.graph.leash import Leash
from course_pkg.graph.master import master_uri
from course_pkg.graph.ports import family, listening_ports, port_of
from course_pkg.graph.probe import ask_all, service_probe
from course_pkg.graph.rpc import MasterClient

TAIL = 2000  # characters of output in an error message
LOOK = 0.02  # s between looks
GRACE = 3.0  # s for a node to end after SIGINT; rospy takes 0.6 s


class NodeProcess:
    """A command that runs one or more nodes; it ends with this process, at the latest.

    What it prints goes to a file of its own, which vanishes with this object: see output().
    """

    def __init__(self, command: Sequence[str], *, label: str = "") -> None:
        self.command = tuple(command)
        self.label = label or os.path.basename(command[0])
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it lives as long as this object
        weakref.finalize(self, self._output.close)
        environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
        self._leash = Leash(self.command, output=self._output, env=environment)
        self.pid = self._leash.pid

    @classmethod
    def rosrun(cls, package: str, executable: str, *args: str, name: str | None = None) -> NodeProcess:
        """Run a package's node, as rosrun does; `name` renames it. Raises UnknownExecutable."""
        program = find_executable(package, executable)
        renamed = [f"__name:={name}"] if name else []
        return cls([str(program), *map(str, args), *renamed], label=name or f"{package}/{executable}")

    @classmethod
    def roslaunch(cls, package: str, file: str, *args: str) -> NodeProcess:
        """Run a launch file, `args` as name:=value; all its nodes end with it."""
        return cls(["roslaunch", package, file, *args], label=f"{package}/{file}")

    @property
    def returncode(self) -> int | None:
        """The exit status, negative for a signal, or None while it runs."""
        return self._leash.returncode

    @property
    def running(self) -> bool:
        """Whether it runs."""
        return self.returncode is None

    def output(self) -> str:
        """Return what it has printed so far, both to stdout and to stderr."""
        file = self._output.fileno()
        return os.pread(file, os.fstat(file).st_size, 0).decode("utf-8", "replace")

    def wait_for_service(self, name: str, timeout: float = 10.0) -> None:
        """Return as soon as this process serves `name` and answers there.

        Raises NodeFailed, with the end of its output, when it ends first or `timeout` s have passed.
        """
        full, deadline = "/" + name.lstrip("/"), time.monotonic() + timeout
        master = MasterClient(master_uri())
        while not self._serves(master, full):
            if not self.running:
                raise self._failed(f"ended with exit status {self.returncode}, and never served {full}")
            if time.monotonic() > deadline:
                raise self._failed(f"runs, and does not serve {full} after {timeout:g} s")
            time.sleep(LOOK)

    def wait_for_output(self, words: str, timeout: float = 10.0) -> None:
        """Return as soon as it has printed `words`.

        Raises NodeFailed, with the end of its output, when it ends first or `timeout` s have passed.
        """
        deadline = time.monotonic() + timeout
        while words not in self.output():
            if not self.running and words not in self.output():
                raise self._failed(f"ended with exit status {self.returncode}, and never printed {words!r}")
            if time.monotonic() > deadline:
                raise self._failed(f"runs, and has not printed {words!r} after {timeout:g} s")
            time.sleep(LOOK)

    def wait(self, timeout: float = 10.0) -> int:
        """Return the exit status once it has ended by itself; raises NodeFailed after `timeout` s."""
        self._leash.wait(timeout)
        status = self.returncode
        if status is None:
            raise self._failed(f"still runs after {timeout:g} s")
        return status

    def interrupt(self) -> None:
        """Ask it to end, as Ctrl-C does, and do not wait."""
        self._leash.signal(signal.SIGCONT)
        self._leash.signal(signal.SIGINT)

    def stop(self, grace: float = GRACE, *, withdraw: bool = True) -> None:
        """End it, by force after `grace` s, and return when it and its registrations are gone."""
        if not self.running:
            return
        left = registered_at(listening_ports(family(self.pid)) or ()) if withdraw else []
        self._leash.end(grace)
        if left:  # by one that had no time to sign off
            take_back(left)

    def kill(self) -> None:
        """Kill it by SIGKILL, which it cannot notice: what it registered stays at the master, stale."""
        self._leash.signal(signal.SIGKILL)
        self._leash.wait(GRACE)

    def __enter__(self) -> NodeProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.label}, {'running' if self.running else 'ended'}>"

    def _serves(self, master: MasterClient, name: str) -> bool:
        """Whether it is this process, and not another by whom the name is still registered, that answers."""
        uri = master.lookup_service(name)
        if uri is None:
            return False
        ports = listening_ports(family(self.pid))
        if ports is not None and port_of(uri) not in ports:
            return False
        probe = service_probe(name, uri)
        ask_all([probe], timeout=1.0)
        return probe.answered

    def _failed(self, what: str) -> NodeFailed:
        tail = self.output()[-TAIL:].strip()
        said = f"The end of what it printed:\n{tail}" if tail else "It printed nothing."
        return NodeFailed(f"{self.label} {what}. {said}", tail, self.returncode)
