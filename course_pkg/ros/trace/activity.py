"""The activity on the graph: the messages on each connection, and the callers of each service.

Every node counts the messages that it sends. The slave API's methods getBusStats and getBusInfo
(http://wiki.ros.org/ROS/Slave_API) return these counts. The course's nodes also count the calls of their
services, for each caller.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, loads

from course_pkg.ros.protocol.probe import Probe, ask_all, rpc_answer, rpc_probe
from course_pkg.ros.protocol.snapshot import Snapshot
from course_pkg.ros.protocol.xmlrpc import RpcValue, items, number

TIMEOUT = 0.5  # This is the time limit of a poll in s.
# The third item of the response to getBusStats contains the statistics of services. In rospy, it is empty.
STATISTICS = "getBusStats"

Callers = dict[str, tuple["ServiceCaller", ...]]
# Reading a response raises one of these errors if the response has an unexpected structure.
INVALID = (ExpatError, Fault, LookupError, TypeError, ValueError)


@dataclass(frozen=True)
class ServiceCaller:
    """A node that has called a service since the server started.

    `calls` counts the requests that reached the server, and `last` is the time of the latest request (s since
    the epoch). `running` counts the requests that a handler is processing.
    """

    node: str
    calls: int
    last: float
    running: int


@dataclass(frozen=True, order=True)
class Traffic:
    """A connection of a topic; `messages` is the number of messages since the connection was opened."""

    topic: str
    publisher: str
    subscriber: str
    connection: int
    messages: int


@dataclass(frozen=True)
class Activity:
    """All counts of one poll.

    `at` is a value of time.monotonic(). `silent` contains the nodes that returned no valid response.
    `callers` maps each service to its callers, the latest caller first. A service has no entry in `callers`
    if its server does not count callers.
    """

    at: float
    traffic: tuple[Traffic, ...] = ()
    silent: frozenset[str] = frozenset()
    callers: Mapping[str, tuple[ServiceCaller, ...]] = field(default_factory=dict)


class ActivityPoller:
    """Polls the nodes of a graph.

    A poller requests the subscriber's name only once for each connection.
    """

    def __init__(self) -> None:
        # The dict maps each node's address to its connections, and each connection to the subscriber.
        self._peers: dict[str, dict[int, str]] = {}

    def poll(self, snapshot: Snapshot, timeout: float = TIMEOUT) -> Activity:
        """Return the counts of all reachable nodes.

        The poll takes at most the time `timeout` (s), or twice this time if there are new connections.
        """
        uris = {node.name: node.uri for node in snapshot.nodes if node.reachable}
        probes = {name: callers_probe(uri) for name, uri in uris.items()}
        ask_all(list(probes.values()), timeout)
        counts = {name: found for name, probe in probes.items() if (found := _counts(probe)) is not None}
        self._update_peers(
            {uris[name]: [each.connection for each in found] for name, found in counts.items()}, timeout
        )
        traffic = [
            Traffic(each.topic, name, peer, each.connection, each.messages)
            for name, found in counts.items()
            for each in found
            if (peer := self._peers[uris[name]].get(each.connection))
        ]
        callers = {name: found for probe in probes.values() for name, found in _callers(probe).items()}
        # Without a known subscriber, the counts of a node cannot be used.
        known = {name for name, found in counts.items() if self._peers[uris[name]] or not found}
        silent = frozenset(node.name for node in snapshot.nodes if node.name not in known)
        return Activity(time.monotonic(), tuple(sorted(traffic)), silent, callers)

    def _update_peers(self, connections: Mapping[str, Iterable[int]], timeout: float) -> None:
        """Request the subscribers of new connections, and delete the entries of nodes that have ended."""
        self._peers = {uri: self._peers.get(uri, {}) for uri in connections}
        new = [uri for uri, numbers in connections.items() if not self._peers[uri].keys() >= set(numbers)]
        probes = {uri: rpc_probe(uri, "getBusInfo") for uri in new}
        ask_all(list(probes.values()), timeout)
        self._peers |= {uri: _subscribers(rpc_answer(probe)) for uri, probe in probes.items()}


def callers_probe(uri: str) -> Probe:
    """Return a probe for ask_all() that requests the statistics of the node at the address `uri`."""
    return rpc_probe(uri, STATISTICS)


def answered_callers(probe: Probe) -> Callers:
    """Return the callers by service; without a response, return an empty dict."""
    stats = rpc_answer(probe)
    if not (isinstance(stats, list) and len(stats) == 3 and isinstance(stats[2], list)):
        return {}
    services = map(items, stats[2])
    return {str(name): tuple(map(_caller, items(callers))) for name, callers in services}


def _caller(row: RpcValue) -> ServiceCaller:
    node, calls, last, running = items(row)
    return ServiceCaller(str(node), int(number(calls)), number(last), int(number(running)))


@dataclass(frozen=True)
class _Count:
    topic: str
    connection: int
    messages: int


def _counts(probe: Probe) -> list[_Count] | None:
    """Return how many messages a node has sent on each connection, or None without a valid response.

    For a topic, rospy returns [name, bytes, connections], and roscpp returns [name, connections]. For a
    connection, rospy returns [id, bytes, messages, connected], and roscpp returns [id, bytes, bytes of
    messages, messages, connected].
    """
    if not probe.answered:
        return None
    try:
        return [
            _Count(str(topic), int(number), int(messages))
            for topic, *_, connections in _statistics(probe)[0]
            for number, *_, messages, _ in connections
        ]
    except INVALID:
        # rospy returns an error after a connection has sent 2 GiB: the byte count is too large for XML-RPC.
        return None


def _callers(probe: Probe) -> Callers:
    """Return the callers of a node's services.

    If the response has an unexpected structure, return an empty dict.
    """
    try:
        return answered_callers(probe)
    except INVALID:
        return {}


def _subscribers(info: RpcValue) -> dict[int, str]:
    """Return the subscribers of a node's outgoing connections.

    If the response has an unexpected structure, return an empty dict.
    """
    try:
        rows = map(items, items(info))
        return {int(number(row[0])): str(row[1]) for row in rows if row[2] == "o"}
    except INVALID:
        return {}


def _statistics(probe: Probe) -> Any:  # noqa: ANN401 -- any node may answer with any value
    """Return the value of a response; roscpp's response to getBusStats has no status."""
    value: Any = loads(probe.answer.partition(b"\r\n\r\n")[2])[0][0]
    return value[2] if value[0] == 1 else value
