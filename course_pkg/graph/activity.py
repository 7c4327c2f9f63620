"""What happens on the graph: the messages that each connection has carried, and who has called which service.

Nobody has to subscribe to find out. Every node counts what it sends, and tells by the slave API's getBusStats
and getBusInfo (http://wiki.ros.org/ROS/Slave_API); the course's nodes count who calls them, too.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, loads

from course_pkg.graph.callers import Callers, ServiceCaller, callers_probe, told_callers
from course_pkg.graph.probe import Probe, ask_all, rpc_answer, rpc_probe
from course_pkg.graph.snapshot import PATIENCE, Snapshot


@dataclass(frozen=True, order=True)
class Carried:
    """A connection of a topic: `messages` went from `publisher` to `subscriber` since it stands."""

    topic: str
    publisher: str
    subscriber: str
    connection: int
    messages: int


@dataclass(frozen=True)
class Activity:
    """All counts at one time.

    `at` is that of time.monotonic() (s), `mute` are the nodes that did not tell what they send. `callers`
    has the services whose servers count their callers, the latest caller first.
    """

    at: float
    carried: tuple[Carried, ...] = ()
    mute: frozenset[str] = frozenset()
    callers: Mapping[str, tuple[ServiceCaller, ...]] = field(default_factory=dict)


class Listener:
    """Asks the nodes of a graph, again and again; what does not change it asks but once."""

    def __init__(self) -> None:
        self._peers: dict[str, dict[int, str]] = {}  # by the address of a node: connection -> subscriber

    def listen(self, snapshot: Snapshot, timeout: float = PATIENCE) -> Activity:
        """Ask all nodes of a snapshot that answer; takes at most `timeout` s, and twice that at first."""
        awake = {node.name: node.uri for node in snapshot.nodes if node.reachable}
        probes = {name: callers_probe(uri) for name, uri in awake.items()}
        ask_all(list(probes.values()), timeout)
        counts = {name: told for name, probe in probes.items() if (told := _counts(probe)) is not None}
        self._meet(
            {awake[name]: [each.connection for each in told] for name, told in counts.items()}, timeout
        )
        carried = [
            Carried(each.topic, name, peer, each.connection, each.messages)
            for name, told in counts.items()
            for each in told
            if (peer := self._peers[awake[name]].get(each.connection))
        ]
        callers = {service: who for probe in probes.values() for service, who in _callers(probe).items()}
        # Without knowing whom its connections lead to, what a node has counted tells nothing.
        clear = {name for name, told in counts.items() if self._peers[awake[name]] or not told}
        mute = frozenset(node.name for node in snapshot.nodes if node.name not in clear)
        return Activity(time.monotonic(), tuple(sorted(carried)), mute, callers)

    def _meet(self, connections: Mapping[str, Iterable[int]], timeout: float) -> None:
        """Ask the nodes with connections that are new whom they lead to; forget nodes that are gone."""
        self._peers = {uri: self._peers.get(uri, {}) for uri in connections}
        new = [uri for uri, numbers in connections.items() if not self._peers[uri].keys() >= set(numbers)]
        probes = {uri: rpc_probe(uri, "getBusInfo") for uri in new}
        ask_all(list(probes.values()), timeout)
        self._peers |= {uri: _peers(rpc_answer(probe) or ()) for uri, probe in probes.items()}


def listen(snapshot: Snapshot, timeout: float = PATIENCE) -> Activity:
    """Ask all nodes of a snapshot once; takes at most twice `timeout` s."""
    return Listener().listen(snapshot, timeout)


@dataclass(frozen=True)
class _Count:
    topic: str
    connection: int
    messages: int


def _counts(probe: Probe) -> list[_Count] | None:
    """Return what a node has sent over each connection, or None if it cannot tell.

    Of a topic, rospy tells [name, bytes, connections], roscpp [name, connections]; of a connection, rospy
    [id, bytes, messages, connected], roscpp [id, bytes, bytes of messages, messages, connected].
    """
    if not probe.answered:
        return None
    try:
        return [
            _Count(str(topic), int(number), int(messages))
            for topic, *_, connections in _bare(probe)[0]
            for number, *_, messages, _ in connections
        ]
    except (ExpatError, Fault, LookupError, TypeError, ValueError):
        # rospy answers by a fault as soon as a connection has carried 2 GiB: XML-RPC has no greater number.
        return None


def _callers(probe: Probe) -> Callers:
    """Return who has called a node's services; a stranger's shape tells nothing."""
    try:
        return told_callers(probe)
    except (LookupError, TypeError, ValueError):
        return {}


def _peers(info: Iterable[Any]) -> dict[int, str]:
    """Return to whom a node's connections lead, of those that lead out; a stranger's shape tells nothing."""
    try:
        return {each[0]: str(each[1]) for each in info if each[2] == "o"}
    except (LookupError, TypeError):
        return {}


def _bare(probe: Probe) -> Any:  # noqa: ANN401 -- what a node answers
    """Return the value of an answer; roscpp's to getBusStats stands alone, without a code and words."""
    value: Any = loads(probe.answer.partition(b"\r\n\r\n")[2])[0][0]
    return value[2] if value[0] == 1 else value
