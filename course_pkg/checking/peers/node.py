"""The node of a check: it reads the graph, and registers services and topics."""

from __future__ import annotations

import os
import signal
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from xmlrpc.server import SimpleXMLRPCServer

import rospy

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import Probe, ask_all, service_probe
from course_pkg.ros.protocol.registrations import registrations, withdraw, withdraw_node

PROBE = 2.0  # A server has to reply with its type within this time in s.


@dataclass(frozen=True)
class Registration:
    """The master's entry for a service: the server's node, the service's address, and the node's address."""

    node: str
    uri: str
    node_uri: str


@dataclass(frozen=True)
class Node:
    """The check's own node, with methods to read the graph."""

    name: str
    uri: str
    master: MasterClient

    def services(self) -> list[str]:
        """Return the names of all services except the two logger services of every node."""
        names = self.master.system_state().services
        return [name for name in names if not name.endswith(("/get_loggers", "/set_logger_level"))]

    def registration(self, service: str) -> Registration | None:
        """Return the registration of the service `service`, or None if no server is registered."""
        providers = self.master.system_state().services.get(service, ())
        uri = self.master.lookup_service(service)
        node_uri = self.master.lookup_node(providers[0]) if providers else None
        return Registration(providers[0], uri, node_uri) if uri and node_uri else None

    def register(self, service: str, uri: str) -> None:
        """Register this node as the server of the service `service`, at the address `uri`."""
        self.master.register_service(self.name, service, uri, self.uri)

    def restore(self, service: str, former: Registration | None) -> None:
        """Register the server `former` of the service again, with the name of its node.

        The master stores one server for each service. The master does not notify a replaced server, so the
        former server does not register again by itself.
        """
        if former:
            self.master.register_service(former.node, service, former.uri, former.node_uri)

    def forget_topics(self, made: Callable[[str], bool]) -> None:
        """Unregister all publishers and subscribers of each topic for which `made` returns True.

        A student's function can leave publishers and subscribers registered.
        """
        entries = registrations(self.master)
        withdraw(self.master, [each for each in entries if each.kind != "service" and made(each.name)])

    def probe(self, service: str) -> Probe | None:
        """Ask the server of this service for its type; return None if no server is registered."""
        if not (uri := self.master.lookup_service(service)):
            return None
        probe = service_probe(service, uri)
        ask_all([probe], PROBE)
        return probe


@contextmanager
def on_the_graph() -> Iterator[Node]:
    """Join the graph as an anonymous node, such as /client_4711_1763949000123; leave the graph at the end.

    The name is similar to the names of other anonymous nodes, so a program cannot recognise a check by its
    name.

    Raises GraphError if the master does not answer.
    """
    name = f"client_{os.getpid()}_{time.time_ns() // 1_000_000}"
    master = MasterClient(master_uri(), caller=f"/{name}")
    master.pid()  # Without a master, init_node would wait for ever.
    # Each check would otherwise write a log file into the student's log folder.
    rospy.core.configure_logging = lambda *_: None
    with held_back(signal.SIGTERM) as came:
        rospy.init_node(name, argv=[name], disable_rosout=True, disable_signals=True)
    node = Node(rospy.get_name(), rospy.get_node_uri(), master)
    try:
        if came:
            signal.raise_signal(signal.SIGTERM)
        yield node
    finally:
        # If the master has ended, there are no registrations to remove. held_back() delays SIGTERM until the
        # end of the block.
        with suppress(GraphError), held_back(signal.SIGTERM):
            # rospy.signal_shutdown is not used, because it sleeps for 0.6 s.
            withdraw_node(master, node.name, node.uri)


@contextmanager
def held_back(number: int) -> Iterator[list[int]]:
    """Ignore a signal during the `with` block; yield a list with the signals that have arrived."""
    came: list[int] = []
    before = signal.signal(number, lambda *_: came.append(number))
    try:
        yield came
    finally:
        signal.signal(number, before)


class FakeNode:
    """A node that never publishes; during the `with` block, it is registered as a publisher of a topic.

    If `alive` is true, the FakeNode has a slave API of its own, so a ping succeeds; `pings` contains the
    methods that were called. If `alive` is false, the port of the address is closed, as after a kill. If
    `reused` is true, the port is open, but each connection is closed, as if another program used the port.
    """

    def __init__(
        self, node: Node, name: str, topic: str, kind: str, *, alive: bool, reused: bool = False
    ) -> None:
        self.name = name
        self._node, self._topic, self._kind = node, topic, kind
        self.alive = alive
        self.pings: list[str] = []
        self._listener = socket.create_server(("127.0.0.1", 0)) if reused else None
        self._api = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) if alive else None
        port = self._listener.getsockname()[1] if self._listener else closed_port()
        self._uri = f"http://localhost:{self._api.server_address[1] if self._api else port}/"

    def __enter__(self) -> FakeNode:
        if self._listener:
            threading.Thread(target=_hang_up, args=(self._listener,), daemon=True).start()
        if self._api:
            self._api.register_instance(self)
            threading.Thread(target=self._api.serve_forever, args=(0.05,), daemon=True).start()
        self._node.master.register_publisher(self.name, self._topic, self._kind, self._uri)
        return self

    def __exit__(self, *_: object) -> None:
        self._node.master.unregister_publisher(self.name, self._topic, self._uri)
        if self._listener:
            with suppress(OSError):
                # This call ends the other thread's accept() with an error.
                self._listener.shutdown(socket.SHUT_RDWR)
            self._listener.close()
        if self._api:
            self._api.shutdown()
            self._api.server_close()

    def _dispatch(self, method: str, _: object) -> list[object]:
        """Answer a call of the slave API (wiki.ros.org/ROS/Slave_API); the node has no topic data."""
        if method == "requestTopic":  # A subscriber of the topic sends this request.
            return [-1, "this node never publishes", 0]
        self.pings.append(method)
        return [1, "", os.getpid() if method == "getPid" else []]


def _hang_up(listener: socket.socket) -> None:
    """Close each connection to the listener, until the listener is closed."""
    with suppress(OSError):
        while True:
            listener.accept()[0].close()


def closed_port() -> int:
    """Return a port of this computer that no program uses."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port: int = listener.getsockname()[1]
        return port
