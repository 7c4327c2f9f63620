"""What is registered below a name, and withdrawing it, be it alive or dead."""

from __future__ import annotations

from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.stale import entries_at, withdraw


def nodes_below(master: MasterClient, start: str) -> list[str]:
    """Return the nodes whose names begin with `start`."""
    return [node for node in master.system_state().nodes if node.startswith(start)]


def withdraw_below(master: MasterClient, start: str) -> int:
    """Withdraw all that nodes whose names begin with `start` have registered; return how many entries."""
    state = master.system_state()
    nodes = [node for node in state.nodes if node.startswith(start)]
    services = [name for name, holders in state.services.items() if set(holders) & set(nodes)]
    found = entries_at(state, *master.lookup_all(nodes, services)) if nodes else []
    return sum(withdraw(master, entry) for entry in found)
