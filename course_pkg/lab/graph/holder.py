"""This process owns a graph: its private network, its master, and the node /rosout.

usage: holder.py LISTENER SOCKET KIND

LISTENER is the descriptor of a listening Unix socket, SOCKET is its path, and KIND is "private" or "shared".
`graph.py` runs this file as a script. Each command that uses the graph has a connection to the socket. The
connection is closed when the command leaves the graph or ends, even by SIGKILL. When the last connection is
closed, the holder ends the graph. The operating system closes the connections of a process that has ended.
The holder therefore does not have to check process ids. After the end of the holder, the operating system
refuses new connections to its socket.

To each command, the holder sends a line of JSON together with the file descriptors of the namespaces. The
holder sends a second line when the master answers, or when the master cannot be started. When a command
leaves while other commands use the graph, the holder closes the command's connection at once. When the last
command leaves, the holder ends the graph, sends `LAST`, and then closes the connection.
"""

from __future__ import annotations

import json
import os
import selectors
import socket
import sys
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from course_pkg.lab.graph.outgoing import Outgoing
    from course_pkg.ros.process.roscore import Roscore

COURSE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
LAST = b"ended"  # The last command receives this message when the graph has ended.
PORT = 11311  # the usual port of a master
FIRST = 30.0  # The command that started this holder has to connect within this time in s.


class Holder:
    """Owns the network and the master of one graph."""

    def __init__(self, listener: socket.socket, path: str, *, private: bool) -> None:
        from course_pkg.ports import free_port
        from course_pkg.ros.process.roscore import Roscore

        self._listener, self._path = listener, path
        self._files: list[int] = []
        self._outgoing: Outgoing | None = None
        self._ready = b""
        reason = self._enter_network() if private else ""
        self._master: Roscore = Roscore(PORT if self._files else free_port())
        self._greeting = _line(uri=self._master.uri, reason=reason)

    def run(self) -> None:
        """Serve commands until the last command has left the graph, and then end the graph."""
        from course_pkg.errors import CourseError

        self._listener.settimeout(FIRST)
        first = self._accept()
        failure = ""
        try:
            self._master.start()
        except CourseError as error:
            failure = str(error)
        self._ready = _line(failure=failure, outgoing=bool(self._outgoing and self._outgoing.works()))
        with suppress(OSError):
            first.sendall(self._ready)
        self._last = self._serve(first)
        with suppress(OSError):
            os.unlink(self._path)
        self._listener.close()
        self._master.stop()
        if self._outgoing:
            self._outgoing.end()
        with suppress(OSError):
            self._last.sendall(LAST)
        # When this process ends, the operating system closes the connection to the last command.

    def _enter_network(self) -> str:
        """Enter a new private network; return the reason if this machine does not allow private networks."""
        from course_pkg.lab.graph import network, outgoing

        try:
            self._files = network.create()
            self._outgoing = outgoing.Outgoing.start(self._files)
            network.enter(self._files)
        except OSError as error:
            return str(error)
        return ""

    def _accept(self) -> socket.socket:
        command, _ = self._listener.accept()
        with suppress(OSError):  # the command may have ended
            socket.send_fds(command, [self._greeting + self._ready], self._files)
        return command

    def _serve(self, first: socket.socket) -> socket.socket:
        """Accept commands, and close the connection of each command that leaves.

        The method does not close the connection of the last command, but returns it.
        """
        with selectors.DefaultSelector() as selector:
            selector.register(self._listener, selectors.EVENT_READ)
            selector.register(first, selectors.EVENT_READ)
            while True:
                for key, _ in selector.select():
                    ready = key.fileobj
                    assert isinstance(ready, socket.socket)
                    if ready is self._listener:
                        selector.register(self._accept(), selectors.EVENT_READ)
                        continue
                    selector.unregister(ready)
                    if len(selector.get_map()) == 1:
                        return ready
                    ready.close()


def _line(**facts: object) -> bytes:
    return json.dumps(facts).encode() + b"\n"


if __name__ == "__main__":
    sys.path.insert(0, COURSE)
    with socket.socket(fileno=int(sys.argv[1])) as given:
        given.set_inheritable(False)
        Holder(given, sys.argv[2], private=sys.argv[3] == "private").run()
