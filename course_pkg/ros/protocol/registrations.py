"""List the registrations at the master, and remove the registrations of nodes that have ended.

Unlike `rosnode cleanup`, this module has a time limit and does not ask for confirmation. This module removes
a registration only if the registered address refuses connections. A suspended node (SIGSTOP) still accepts
connections, so its registrations are not removed.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import dataclass

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient, SystemState, master_uri
from course_pkg.ros.protocol.xmlrpc import port_of

TIMEOUT = 0.5  # Wait up to this time in s for the responses of all nodes.
METHODS = {
    "publisher": "unregisterPublisher",
    "subscriber": "unregisterSubscriber",
    "service": "unregisterService",
}


@dataclass(frozen=True, order=True)
class Registration:
    """One registration: `kind` is "publisher", "subscriber" or "service"; `uri` is the registered address."""

    node: str
    kind: str
    name: str
    uri: str


def registrations(master: MasterClient, nodes: Collection[str] | None = None) -> list[Registration]:
    """Return the sorted registrations of all nodes, or of some nodes, with two requests to the master.

    All functions of this module raise GraphError if a request to the master fails.
    """
    state = master.system_state()
    entries = [entry for entry in _entries(state) if nodes is None or entry[0] in nodes]
    holders = {node for node, kind, _ in entries if kind != "service"}
    services = {name for _, kind, name in entries if kind == "service"}
    uris, service_uris = master.lookup_all(sorted(holders), sorted(services))
    return sorted(
        Registration(node, kind, name, uri)
        for node, kind, name in entries
        if (uri := service_uris.get(name) if kind == "service" else uris.get(node))
    )


def withdraw(master: MasterClient, entries: Iterable[Registration]) -> list[Registration]:
    """Remove the registrations `entries` with one request, and return the removed entries.

    The master removes an entry only if the address is still the registered address. Therefore, registrations
    of other processes are not removed.
    """
    listed = list(entries)
    answers = master.multicall([(METHODS[each.kind], each.node, each.name, each.uri) for each in listed])
    return [entry for entry, answer in zip(listed, answers, strict=True) if answer]


def withdraw_node(master: MasterClient, node: str, node_uri: str) -> list[Registration]:
    """Unregister the node if it is registered with this address; a newer node of the same name stays.

    If a second process registers with the same node name, the master deletes the registrations of the first
    process (rosmaster/registrations.py). Therefore, all registrations under a node name belong to the process
    that has the registered address.
    """
    if master.lookup_node(node) != node_uri:
        return []
    return withdraw(master, registrations(master, [node]))


def withdraw_below(master: MasterClient, prefix: str) -> list[Registration]:
    """Unregister all nodes with names that begin with this prefix, even running nodes."""
    nodes = [node for node in master.system_state().nodes if node.startswith(prefix)]
    return withdraw(master, registrations(master, nodes)) if nodes else []


def registered_at(ports: Collection[int]) -> list[Registration]:
    """Return the registrations whose addresses have one of these ports; without a master, return [].

    The function uses the master at ROS_MASTER_URI. A process listens on the ports of the addresses that it
    registers. Read the ports while the process runs, because an ended process listens on no port.
    """
    if ports:
        with suppress(GraphError):  # Without a master, there are no registrations.
            return [
                entry for entry in registrations(MasterClient(master_uri())) if port_of(entry.uri) in ports
            ]
    return []


def remove_stale(
    uri: str | None = None, timeout: float = 2.0, nodes: Collection[str] | None = None
) -> list[Registration]:
    """Unregister all ended nodes, or only the ended nodes in `nodes`; return the removed registrations."""
    master = MasterClient(uri or master_uri(), timeout)
    return withdraw(master, _stale(master, nodes, min(timeout, TIMEOUT)))


def _stale(master: MasterClient, nodes: Collection[str] | None, timeout: float) -> list[Registration]:
    # The supervisor imports this module without the libraries of ROS, so this import is inside the function.
    from course_pkg.ros.protocol.probe import Reach, ask_all, node_probe, service_probe

    entries = registrations(master, nodes)
    probes = {
        each.uri: service_probe(each.name, each.uri) if each.kind == "service" else node_probe(each.uri)
        for each in entries
    }
    ask_all(list(probes.values()), timeout)
    return [each for each in entries if probes[each.uri].reach is Reach.REFUSED]


def _entries(state: SystemState) -> list[tuple[str, str, str]]:
    """Return (node, kind, name) for each registration."""
    kinds = {"publisher": state.publishers, "subscriber": state.subscribers, "service": state.services}
    return [
        (node, kind, name)
        for kind, registered in kinds.items()
        for name, nodes in registered.items()
        for node in nodes
    ]
