"""What happens on the graph: the messages that each connection has carried, and who has called which service.

Nobody has to subscribe to find out. Every node counts what it sends, and tells by the slave API's getBusStats
and getBusInfo (http://wiki.ros.org/ROS/Slave_API); the course's nodes count who calls them, too.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, loads

from course_pkg.graph.callers import ServiceCaller, callers_probe, told_callers
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


def listen(snapshot: Snapshot, timeout: float = PATIENCE) -> Activity:
    """Ask all nodes of a snapshot that answer; takes at most `timeout` s."""
    awake = [node for node in snapshot.nodes if node.reachable]
    stats = {node.name: callers_probe(node.uri) for node in awake}
    info = {node.name: rpc_probe(node.uri, "getBusInfo") for node in awake}
    ask_all([*stats.values(), *info.values()], timeout)
    told = {name: _carried(name, stats[name], info[name]) for name in stats}
    callers = {service: who for probe in stats.values() for service, who in told_callers(probe).items()}
    carried = sorted(each for counts in told.values() for each in counts or ())
    mute = frozenset(node.name for node in snapshot.nodes if told.get(node.name) is None)
    return Activity(time.monotonic(), tuple(carried), mute, callers)


def _carried(node: str, stats: Probe, info: Probe) -> list[Carried] | None:
    """Return what a node has sent over each connection, or None if it cannot tell."""
    if not stats.answered:
        return None
    try:
        peers = {each[0]: str(each[1]) for each in rpc_answer(info) if each[2] == "o"}
        return list(_counts(node, _bare(stats)[0], peers))
    except (ExpatError, Fault, LookupError, TypeError, ValueError):
        # rospy answers by a fault as soon as a connection has carried 2 GiB: XML-RPC has no greater number.
        return None


def _bare(probe: Probe) -> Any:  # noqa: ANN401 -- what a node answers
    """Return the value of an answer; roscpp's to getBusStats stands alone, without a code and words."""
    value = loads(probe.answer.partition(b"\r\n\r\n")[2])[0][0]
    return value[2] if value[0] == 1 else value


def _counts(node: str, topics: list[Any], peers: Mapping[int, str]) -> Iterator[Carried]:
    """Yield the connections of a node's publishers.

    Of a topic, rospy tells [name, bytes, connections], roscpp [name, connections]; of a connection, rospy
    [id, bytes, messages, connected], roscpp [id, bytes, bytes of messages, messages, connected].
    """
    for topic, *_, connections in topics:
        for number, *_, messages, _ in connections:
            if number in peers:
                yield Carried(str(topic), node, peers[number], int(number), int(messages))
