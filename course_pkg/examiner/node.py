"""The judge as a node on the graph, for as long as one check takes."""

from __future__ import annotations

import secrets
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass

import rospy

from course_pkg.errors import GraphError
from course_pkg.graph.master import master_uri
from course_pkg.graph.probe import Probe, ask_all, service_probe
from course_pkg.graph.rpc import MasterClient

PROBE = 2.0  # s for a server to say what it serves


@dataclass(frozen=True)
class Registration:
    """What the master knows about a service: its provider, and the addresses of both."""

    node: str
    uri: str
    node_uri: str


@dataclass(frozen=True)
class Node:
    """The judge's own node, and its view of the graph."""

    name: str
    uri: str
    master: MasterClient

    def services(self) -> list[str]:
        """Return the names of all services but those that every node has for its log."""
        names = self.master.system_state().services
        return [name for name in names if not name.endswith(("/get_loggers", "/set_logger_level"))]

    def registration(self, service: str) -> Registration | None:
        """Return who is registered for `service`, or None."""
        providers = self.master.system_state().services.get(service, ())
        uri = self.master.lookup_service(service)
        node_uri = self.master.lookup_node(providers[0]) if providers else None
        return Registration(providers[0], uri, node_uri) if uri and node_uri else None

    def forget_topics(self, made: Callable[[str], bool]) -> None:
        """Take the topics of `made` names off the graph, whoever registered them.

        What a student's function began on a topic of a check's own goes on, and so would its name.
        """
        state, master = self.master.system_state(), self.master
        for table, withdraw in (
            (state.publishers, master.unregister_publisher),
            (state.subscribers, master.unregister_subscriber),
        ):
            for topic in filter(made, table):
                for node in table[topic]:
                    withdraw(node, topic, master.lookup_node(node) or "")

    def probe(self, service: str) -> Probe | None:
        """Ask who serves `service` what it is; return None when nobody is registered."""
        if not (uri := self.master.lookup_service(service)):
            return None
        probe = service_probe(service, uri)
        ask_all([probe], PROBE)
        return probe


@contextmanager
def on_the_graph(check: str) -> Iterator[Node]:
    """Join under a name like /examiner_05_1_a1b2c3d4, and take every registration back at the end."""
    name = f"examiner_{check.replace('.', '_')}_{secrets.token_hex(4)}"
    master = MasterClient(master_uri(), caller=f"/{name}")
    master.pid()  # init_node would wait for ever for a master that is not there
    # A log file for each check would fill the student's log folder, and nobody would read it.
    rospy.core.configure_logging = lambda *_: None
    with held_back(signal.SIGTERM) as came:
        rospy.init_node(name, argv=[name], disable_rosout=True, disable_signals=True)
    node = Node(rospy.get_name(), rospy.get_node_uri(), master)
    try:
        if came:
            signal.raise_signal(signal.SIGTERM)
        yield node
    finally:
        # A master that is gone has nothing to take back; and an end that comes now waits until it is done.
        with suppress(GraphError), held_back(signal.SIGTERM):
            _leave(node)


@contextmanager
def held_back(number: int) -> Iterator[list[int]]:
    """Hold a signal back in this block, and note that it came: half a start or half an end helps nobody."""
    came: list[int] = []
    before = signal.signal(number, lambda *_: came.append(number))
    try:
        yield came
    finally:
        signal.signal(number, before)


def _leave(node: Node) -> None:
    """Unregister what is registered, without rospy.signal_shutdown, which sleeps for 0.6 s."""
    state, master = node.master.system_state(), node.master
    for topic in (name for name, nodes in state.publishers.items() if node.name in nodes):
        master.unregister_publisher(node.name, topic, node.uri)
    for topic in (name for name, nodes in state.subscribers.items() if node.name in nodes):
        master.unregister_subscriber(node.name, topic, node.uri)
    for service in (name for name, nodes in state.services.items() if node.name in nodes):
        master.unregister_service(node.name, service, master.lookup_service(service) or "")
