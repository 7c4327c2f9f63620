"""The graph at one moment: its nodes, topics and services."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from course_pkg.ros.protocol.master_api import MasterClient, SystemState, master_uri
from course_pkg.ros.protocol.probe import Probe, Reach, ask_all, header_fields, node_probe, service_probe

if TYPE_CHECKING:
    from course_pkg.types import Plain

# A node has to respond within this time in s.
TIMEOUT = 0.5


@dataclass(frozen=True, order=True)
class NodeSeen:
    """A registered node; `reach` is "answered", "refused" (ended), "silent" (suspended or busy) or "lost"."""

    name: str
    uri: str
    reach: str

    @property
    def reachable(self) -> bool:
        """Whether the node answers."""
        return self.reach == Reach.ANSWERED.value


@dataclass(frozen=True, order=True)
class TopicSeen:
    """A topic; `type` is "" if no node has registered a type for the topic."""

    name: str
    type: str
    publishers: tuple[str, ...]
    subscribers: tuple[str, ...]


@dataclass(frozen=True, order=True)
class ServiceSeen:
    """A service; `node` is its server, and `type` is "" if the server does not answer."""

    name: str
    type: str
    node: str
    uri: str
    reach: str

    @property
    def reachable(self) -> bool:
        """Whether the server answers."""
        return self.reach == Reach.ANSWERED.value


@dataclass(frozen=True)
class Snapshot:
    """All nodes, topics and services, sorted by name.

    Two snapshots are equal if all their nodes, topics and services are equal.
    """

    master: str
    nodes: tuple[NodeSeen, ...]
    topics: tuple[TopicSeen, ...]
    services: tuple[ServiceSeen, ...]

    def service(self, name: str) -> ServiceSeen | None:
        """Return the service with this name, or None if the snapshot does not contain this service."""
        return next((service for service in self.services if service.name == name), None)

    def node(self, name: str) -> NodeSeen | None:
        """Return the node with this name, or None if the snapshot does not contain this node."""
        return next((node for node in self.nodes if node.name == name), None)

    def as_dict(self) -> dict[str, Plain]:
        """Return the snapshot as plain data, for JSON."""
        return asdict(self)


def look(uri: str | None = None, timeout: float = 2.0) -> Snapshot:
    """Return the graph of the master at the address `uri`; the default is the master at ROS_MASTER_URI.

    Each request to the master takes at most `timeout` s. All services are probed together for at most 0.5 s,
    and then all nodes for at most 0.5 s. Raises MasterUnreachable, MasterSilent, MalformedMasterUri or
    NotAMaster if no master answers at the address.
    """
    master = MasterClient(uri or master_uri(), timeout)
    state, types = master.system_state(), master.topic_types()
    node_uris, service_uris = master.lookup_all(state.nodes, state.services)
    node_timeout = min(timeout, TIMEOUT)
    services = {name: service_probe(name, uri) for name, uri in service_uris.items()}
    ask_all(list(services.values()), node_timeout)
    seen = tuple(_service(name, state, service_uris, probe) for name, probe in services.items())
    nodes = _nodes(node_uris, seen, node_timeout)
    return Snapshot(master.uri, nodes, _topics(state, types), tuple(sorted(seen)))


def _service(name: str, state: SystemState, uris: dict[str, str], probe: Probe) -> ServiceSeen:
    kind = header_fields(probe.answer).get("type", "") if probe.answered else ""
    return ServiceSeen(name, kind, state.services[name][0], uris[name], probe.reach.value)


def _nodes(uris: dict[str, str], services: Iterable[ServiceSeen], timeout: float) -> tuple[NodeSeen, ...]:
    """Return all nodes; a node that has already answered the probe of its service is not probed again."""
    answered = {service.node for service in services if service.reachable}
    probes = {name: node_probe(uri) for name, uri in uris.items() if name not in answered}
    ask_all(list(probes.values()), timeout)
    reaches = {name: probe.reach for name, probe in probes.items()}
    return tuple(
        NodeSeen(name, uri, reaches.get(name, Reach.ANSWERED).value) for name, uri in sorted(uris.items())
    )


def _topics(state: SystemState, types: dict[str, str]) -> tuple[TopicSeen, ...]:
    names = sorted({*state.publishers, *state.subscribers})
    return tuple(
        TopicSeen(name, types.get(name, ""), state.publishers.get(name, ()), state.subscribers.get(name, ()))
        for name in names
    )
