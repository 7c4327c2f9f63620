"""A separate graph, for experiments that would harm the other nodes of a shared graph."""

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

READY = 15.0  # Wait up to this time in s until a node is on the graph.
INTERVAL = 0.02  # This is the time in s between two polls of the master.


class PrivateGraph:
    """A ROS graph that consists of a private master and the programs that use this master.

    The master and the programs end when close() is called, at the end of a `with` block, or when this object
    is deleted.
    """

    def __init__(self) -> None:
        self._master = PrivateMaster().start()
        self._processes: list[NodeProcess] = []
        self._end = weakref.finalize(self, _end, self._master, self._processes)

    @property
    def uri(self) -> str:
        """The address of the graph's master, the value for ROS_MASTER_URI."""
        return self._master.uri

    def run(self, package: str, executable: str, *args: str) -> NodeProcess:
        """Run a package's node on this graph in a new process, and return when the node is registered.

        Raises UnknownExecutable if there is no such program, and NodeFailed if the node is not on the graph
        after 15 s.
        """
        process = self.start(str(find_executable(package, executable)), *args)
        ready = wait_until(lambda: self._knows(process) or not process.running, READY, INTERVAL)
        if ready and process.running:
            return process
        raise NodeFailed(
            f"{package}/{executable} has ended, or is not on this private graph after "
            f"{READY:g} s. The output of the program: {process.output() or 'none'}",
            process.output(),
            process.returncode,
        )

    def start(self, *command: str) -> NodeProcess:
        """Start a command on this graph, such as ("rostopic", "echo", "/pulse"), and return at once."""
        # `env` replaces itself with the command, so the process id does not change.
        line = ["env", f"ROS_MASTER_URI={self.uri}", "ROS_HOSTNAME=localhost", *map(str, command)]
        self._processes.append(NodeProcess(line, label=command[0].rpartition("/")[2]))
        return self._processes[-1]

    def kill_master(self) -> None:
        """End only the master; the programs of the graph continue."""
        self._master.stop()

    def close(self) -> None:
        """End all programs and the master; a second call has no effect."""
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
        """Return whether any registered node has a port that `process` listens on."""
        master = MasterClient(self.uri)
        try:
            nodes, _ = master.lookup_all(master.system_state().nodes, ())
        except GraphError:
            return False
        ports = process.listening_ports()
        return any(port_of(uri) in ports for uri in nodes.values())


def _end(master: PrivateMaster, processes: list[NodeProcess]) -> None:
    """End all programs at the same time, and then the master with all registrations."""
    for process in processes:
        process.interrupt()
    while processes:
        processes.pop().stop(unregister=False)
    master.stop()
