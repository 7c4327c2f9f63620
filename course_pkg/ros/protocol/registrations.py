"""What nodes have registered at the master, and withdrawing it for nodes that cannot do it themselves.

Like `rosnode cleanup`, but in bounded time, without asking the user, and only for dead nodes: its address
refuses connections. A node that is stopped accepts them, and keeps its registrations.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import dataclass

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient, SystemState, master_uri
from course_pkg.ros.protocol.xmlrpc import port_of

TIMEOUT = 0.5  # s for all nodes to answer
METHODS = {
    "publisher": "unregisterPublisher",
    "subscriber": "unregisterSubscriber",
    "service": "unregisterService",
}


@dataclass(frozen=True, order=True)
class Registration:
    """One entry of the master; `kind` is "publisher", "subscriber" or "service", `uri` the address there."""

    node: str
    kind: str
    name: str
    uri: str


def registrations(master: MasterClient, nodes: Collection[str] | None = None) -> list[Registration]:
    """Return what all nodes, or these, have registered, sorted; two requests to the master.

    Raises GraphError, as every call to the master may; so do the other functions of this module.
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
    """Withdraw these entries in one request, and return those that were there.

    The master compares the address: an entry that belongs to another process by now stays.
    """
    listed = list(entries)
    answers = master.multicall([(METHODS[each.kind], each.node, each.name, each.uri) for each in listed])
    return [entry for entry, answer in zip(listed, answers, strict=True) if answer]


def withdraw_node(master: MasterClient, node: str, node_uri: str) -> list[Registration]:
    """Withdraw all that the node with this address has registered, and nothing of a successor by its name.

    The master forgets the entries of a name as soon as another address registers under it
    (rosmaster/registrations.py), so that the address of the name tells to which process they belong.
    """
    if master.lookup_node(node) != node_uri:
        return []
    return withdraw(master, registrations(master, [node]))


def withdraw_below(master: MasterClient, prefix: str) -> list[Registration]:
    """Withdraw all that nodes whose names begin with `prefix` have registered, whether they live or not."""
    nodes = [node for node in master.system_state().nodes if node.startswith(prefix)]
    return withdraw(master, registrations(master, nodes)) if nodes else []


def registered_at(ports: Collection[int]) -> list[Registration]:
    """Return what ROS_MASTER_URI's master has registered at these ports; nothing where no master answers.

    A process listens on the ports of its registrations: look at them while it lives.
    """
    if ports:
        with suppress(GraphError):  # no node is left to be registered with
            return [
                entry for entry in registrations(MasterClient(master_uri())) if port_of(entry.uri) in ports
            ]
    return []


def remove_stale(
    uri: str | None = None, timeout: float = 2.0, nodes: Collection[str] | None = None
) -> list[Registration]:
    """Withdraw the entries of dead nodes, all or those of `nodes`, and return what was withdrawn."""
    master = MasterClient(uri or master_uri(), timeout)
    return withdraw(master, _stale(master, nodes, min(timeout, TIMEOUT)))


def _stale(master: MasterClient, nodes: Collection[str] | None, timeout: float) -> list[Registration]:
    # Not at the top: the supervisor reads this module without the libraries of ROS.
    from course_pkg.ros.protocol.probe import Reach, ask_all, node_probe, service_probe

    entries = registrations(master, nodes)
    probes = {
        each.uri: service_probe(each.name, each.uri) if each.kind == "service" else node_probe(each.uri)
        for each in entries
    }
    ask_all(list(probes.values()), timeout)
    return [each for each in entries if probes[each.uri].reach is Reach.REFUSED]


def _entries(state: SystemState) -> list[tuple[str, str, str]]:
    """Return (node, kind, name) of each entry."""
    kinds = {"publisher": state.publishers, "subscriber": state.subscribers, "service": state.services}
    return [
        (node, kind, name)
        for kind, registered in kinds.items()
        for name, nodes in registered.items()
        for node in nodes
    ]
