"""What processes leave registered at the master that have no time to sign off.

Whose an entry is, the ports tell on which a process listens: look at them while it lives.
"""

from __future__ import annotations

from collections.abc import Collection

from course_pkg.errors import GraphError
from course_pkg.graph.master import master_uri
from course_pkg.graph.ports import port_of
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.stale import StaleRegistration, entries_at, withdraw


def registered_at(ports: Collection[int]) -> list[StaleRegistration]:
    """Return what the master has registered at these ports; nothing where no master answers."""
    try:
        master = MasterClient(master_uri())
        state = master.system_state()
        nodes, services = (
            {name: uri for name, uri in found.items() if port_of(uri) in ports}
            for found in master.lookup_all(state.nodes, state.services)
        )
    except GraphError:
        return []  # nobody left to be registered with
    return entries_at(state, nodes, services)


def take_back(entries: Collection[StaleRegistration]) -> None:
    """Withdraw these entries; one that is another's by now stays."""
    try:
        master = MasterClient(master_uri())
        for entry in entries:
            withdraw(master, entry)
    except GraphError:
        return
