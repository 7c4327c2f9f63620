"""A command joins the running graph or starts a new graph, and leaves the graph at the end."""

from __future__ import annotations

import json
import os
import platform
import secrets
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from enum import Enum
from pathlib import Path

from course_pkg.errors import GraphError
from course_pkg.lab.graph.holder import LAST
from course_pkg.ros.process.master import OTHER_ADDRESSES
from course_pkg.state import locked, state_folder

PROGRAM = Path(__file__).with_name("holder.py")
ANSWER = 60.0  # The holder has to answer within this time in s, even on a busy machine.


class Which(Enum):
    """The graph that a command uses."""

    RUNNING = "running"  # the newest running graph, or a new private graph if no graph is running
    NEW = "new"  # a new private graph; later commands with RUNNING join it
    ALONE = "alone"  # a new private graph that no other command can join
    SHARED = "shared"  # a new graph in the network of the machine; later commands with RUNNING join it


class Graph:
    """A graph that this command uses until leave() is called.

    `uri` is the address of the master. `files` are the file descriptors of the private network's namespaces.
    If `files` is empty, the graph uses the network of this machine. In this case, `reason` says why there is
    no private network. If the user asked for the network of this machine, `reason` is "". After
    wait_for_master(), `outgoing` says whether programs in the private network can connect to other computers.
    """

    def __init__(
        self, connection: socket.socket, path: Path, holder: subprocess.Popen[bytes] | None = None
    ) -> None:
        self._connection, self._path, self._holder = connection, path, holder
        connection.settimeout(ANSWER)
        greeting, self.files, _, _ = socket.recv_fds(connection, 1 << 16, 2)
        if not greeting:
            raise ConnectionResetError("the process that holds the graph has ended")
        line, _, self._rest = greeting.partition(b"\n")
        facts = json.loads(line)
        self.uri: str = facts["uri"]
        self.reason: str = facts["reason"]
        self.outgoing = False
        for file in self.files:
            os.set_inheritable(file, False)

    def wait_for_master(self) -> None:
        """Return as soon as the master answers; raises GraphError if the master cannot be started."""
        while not self._rest.endswith(b"\n"):
            received = self._connection.recv(1 << 16)
            if not received:
                raise GraphError("The process that starts the ROS master has ended. Start the command again.")
            self._rest += received
        facts = json.loads(self._rest)
        if facts["failure"]:
            raise GraphError(facts["failure"])
        self.outgoing = facts["outgoing"]

    def leave(self) -> None:
        """Leave the graph. If no other command uses the graph, wait until its processes have ended."""
        received = b""
        with self._connection, suppress(OSError):
            self._connection.shutdown(socket.SHUT_WR)
            while part := self._connection.recv(1 << 16):
                received = part
        if self._holder and received.endswith(LAST):
            self._holder.wait()
        elif self._holder:
            # The holder continues to run for other commands, so this process does not wait for it.
            self._holder.returncode = 0
        if not received.endswith(LAST) and (left := _connected(self._path)):
            # If there is a connection, the holder still runs. After the holder was killed, _connected()
            # removes the holder's socket and returns None. If the holder has been killed, _connected()
            # removes its socket and returns None.
            left.close()
        for file in self.files:
            os.close(file)
        self.files = []


@contextmanager
def graph_of_this_command(which: Which) -> Iterator[Graph | None]:
    """Run the `with` block on a graph; ROS_MASTER_URI contains the address of its master.

    If `which` is RUNNING and ROS_MASTER_URI is already set, no graph is used: the block gets None, and
    ROS_MASTER_URI does not change. Raises GraphError if the graph cannot be started.
    """
    if os.environ.get("ROS_MASTER_URI") and which is Which.RUNNING:
        yield None
        return
    graph = join_or_start(which, state_folder() / "graphs")
    kept = {name: os.environ.pop(name, None) for name in ("ROS_MASTER_URI", "ROS_HOSTNAME", *OTHER_ADDRESSES)}
    os.environ.update(ROS_MASTER_URI=graph.uri, ROS_HOSTNAME="localhost")
    try:
        yield graph
    finally:
        graph.leave()
        for name, value in kept.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value


def join_or_start(which: Which, folder: Path) -> Graph:
    """Return the graph for a command; `folder` contains a socket for each graph that can be joined."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with locked(folder, ANSWER):
            running = _running(folder) if which is Which.RUNNING else None
            return running or _start(which, folder)
    except (OSError, ValueError) as error:
        raise GraphError(f"The ROS graph cannot be started in {folder}: {error}.") from error


def _running(folder: Path) -> Graph | None:
    """Return the newest running graph, and remove the sockets of graphs that have ended.

    Another computer may use the same home folder. Therefore, only the sockets of this computer are used.
    """
    sockets = sorted(folder.glob(f"{platform.node()}.*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for path in sockets:
        if connection := _connected(path):
            with suppress(OSError):  # The holder may have ended in the meantime.
                return Graph(connection, path)
            connection.close()
    return None


def _connected(path: Path) -> socket.socket | None:
    """Return a connection to the holder process that has the socket `path`.

    If the holder has ended, remove the socket and return None.
    """
    connection = socket.socket(socket.AF_UNIX)
    try:
        with _short(path) as name:
            connection.connect(name)
    except OSError:
        connection.close()
        path.unlink(missing_ok=True)
        return None
    return connection


def _start(which: Which, folder: Path) -> Graph:
    path = folder / f"{platform.node()}.{secrets.token_hex(4)}"
    connection = socket.socket(socket.AF_UNIX)
    with socket.socket(socket.AF_UNIX) as listener, _short(path) as name:
        listener.bind(name)
        listener.listen()
        kind = "shared" if which is Which.SHARED else "private"
        command = [sys.executable, "-I", "-S", str(PROGRAM), str(listener.fileno()), str(path), kind]
        holder = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            pass_fds=[listener.fileno()],
            start_new_session=True,  # Ctrl-C in this terminal does not end a graph that other commands use
        )
        connection.connect(name)
    if which is Which.ALONE:
        path.unlink()
    return Graph(connection, path, holder)


@contextmanager
def _short(path: Path) -> Iterator[str]:
    """Yield a short name for the path, because the name of a Unix socket has at most 107 bytes."""
    folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)
