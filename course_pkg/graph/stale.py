"""Registrations that a dead node left at the master: finding them, and taking them away.

Like `rosnode cleanup`, but bounded, without a question, and only for what is provably dead: nobody listens
at the address any more. A node that is stopped is silent, and keeps its registrations.
"""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.graph.master import master_uri
from course_pkg.graph.probe import Probe, Reach, ask_all, node_probe, service_probe
from course_pkg.graph.rpc import Addresses, MasterClient, SystemState

PATIENCE = 0.5  # s


@dataclass(frozen=True, order=True)
class StaleRegistration:
    """One entry of the master that leads nowhere; `kind` is "publisher", "subscriber" or "service"."""

    node: str
    kind: str
    name: str
    uri: str


def stale_registrations(uri: str | None = None, timeout: float = 2.0) -> list[StaleRegistration]:
    """Return the stale entries of the master at `uri`, by default ROS_MASTER_URI's, sorted.

    Each question to the master takes at most `timeout` s, asking all nodes at most 0.5 s more.
    """
    return _found(MasterClient(uri or master_uri(), timeout), min(timeout, PATIENCE))


def remove_stale(
    uri: str | None = None, timeout: float = 2.0, nodes: frozenset[str] | None = None
) -> list[StaleRegistration]:
    """Remove the stale entries, all or those of `nodes`, and return what was removed."""
    master = MasterClient(uri or master_uri(), timeout)
    found = _found(master, min(timeout, PATIENCE))
    return [entry for entry in found if (nodes is None or entry.node in nodes) and withdraw(master, entry)]


def withdraw(master: MasterClient, entry: StaleRegistration) -> bool:
    """Take one entry away, if it is still the same; say whether it was there."""
    ways = {
        "publisher": master.unregister_publisher,
        "subscriber": master.unregister_subscriber,
        "service": master.unregister_service,
    }
    return ways[entry.kind](entry.node, entry.name, entry.uri)


def entries_at(state: SystemState, nodes: Addresses, services: Addresses) -> list[StaleRegistration]:
    """Return what is registered for these nodes and these services, given with their addresses."""
    found = [
        StaleRegistration(node, kind, topic, nodes[node])
        for kind, topics in (("publisher", state.publishers), ("subscriber", state.subscribers))
        for topic, holders in topics.items()
        for node in holders
        if node in nodes
    ]
    found += [
        StaleRegistration(node, "service", name, services[name])
        for name, holders in state.services.items()
        for node in holders
        if name in services
    ]
    return sorted(found)


def _found(master: MasterClient, patience: float) -> list[StaleRegistration]:
    state = master.system_state()
    nodes, services = master.lookup_all(state.nodes, state.services)
    probes: dict[str, Probe] = {f"node {name}": node_probe(uri) for name, uri in nodes.items()}
    probes |= {f"service {name}": service_probe(name, uri) for name, uri in services.items()}
    ask_all(list(probes.values()), patience)
    dead = {name for name, probe in probes.items() if probe.reach is Reach.REFUSED}
    return entries_at(
        state,
        {name: uri for name, uri in nodes.items() if f"node {name}" in dead},
        {name: uri for name, uri in services.items() if f"service {name}" in dead},
    )
