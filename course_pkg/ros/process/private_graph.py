"""A separate graph, for trying out what would harm the other nodes of a shared one."""

from __future__ import annotations

import weakref
from types import TracebackType

from course_pkg.errors import GraphError, NodeFailed
from course_pkg.ros.process.executables import find_executable
from course_pkg.ros.process.master import PrivateMaster
from course_pkg.ros.process.node_process import NodeProcess
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.ros.protocol.xmlrpc import port_of
from course_pkg.waiting import wait_until

READY = 15.0  # s for a node to be on the graph
INTERVAL = 0.02  # s between polls


class PrivateGraph:
    """A master of its own and the programs that are started on it; no other node connects to it.

    All of it ends with close(), with the block of a `with` statement, or with this object.
    """

    def __init__(self) -> None:
        self._master = PrivateMaster().start()
        self._processes: list[NodeProcess] = []
        self._end = weakref.finalize(self, _end, self._master, self._processes)

    @property
    def uri(self) -> str:
        """The address of its master, for ROS_MASTER_URI."""
        return self._master.uri

    def run(self, package: str, executable: str, *args: str) -> NodeProcess:
        """Run a package's node there, and return when its master knows it; every call starts another one.

        Raises UnknownExecutable, and NodeFailed when it is not on the graph after 15 s.
        """
        process = self.start(str(find_executable(package, executable)), *args)
        ready = wait_until(lambda: self._knows(process) or not process.running, READY, INTERVAL)
        if ready and process.running:
            return process
        raise NodeFailed(
            f"{package}/{executable} is not on this private graph after {READY:g} s, or it has ended. What "
            f"it printed: {process.output() or 'nothing'}",
            process.output(),
            process.returncode,
        )

    def start(self, *command: str) -> NodeProcess:
        """Start any command there, such as ("rostopic", "echo", "/pulse"), and return at once."""
        # `env` replaces itself by the command: the process stays the same.
        line = ["env", f"ROS_MASTER_URI={self.uri}", "ROS_HOSTNAME=localhost", *map(str, command)]
        self._processes.append(NodeProcess(line, label=command[0].rpartition("/")[2]))
        return self._processes[-1]

    def kill_master(self) -> None:
        """End the master, and nothing else."""
        self._master.stop()

    def close(self) -> None:
        """End all programs and the master; a second close changes nothing."""
        self._end()

    def __enter__(self) -> PrivateGraph:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        alive = sum(process.running for process in self._processes)
        master = "a master" if self._master.running else "no master"
        return f"<a private graph with {master} and {alive} programs>"

    def _knows(self, process: NodeProcess) -> bool:
        """Return whether a node of the process is registered; its port shows that it is this one."""
        master = MasterClient(self.uri)
        try:
            nodes, _ = master.lookup_all(master.system_state().nodes, ())
        except GraphError:
            return False
        ports = process.listening_ports()
        return any(port_of(uri) in ports for uri in nodes.values())


def _end(master: PrivateMaster, processes: list[NodeProcess]) -> None:
    """End the programs side by side, then the master; what they have registered ends with it."""
    for process in processes:
        process.interrupt()
    while processes:
        processes.pop().stop(unregister=False)
    master.stop()
