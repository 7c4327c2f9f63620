"""The current publishers and subscribers of a topic, with the type that each of these nodes uses.

The master stores only one type for each topic: the type that the first node registered. Each node returns its
own type in the response to getPublications or getSubscriptions: http://wiki.ros.org/ROS/Slave_API.
"""

from __future__ import annotations

from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.ros.protocol.probe import ask_all, rpc_answer, rpc_probe
from course_pkg.ros.protocol.xmlrpc import RpcValue
from course_pkg.ros.topic.reports import Connections, Peer

TIMEOUT = 0.5  # Wait up to this time in s for the responses of all nodes.
ANY = "*"  # This is the type of a subscriber that accepts all types, such as `rostopic echo`.


def find_connections(master: MasterClient, topic: str) -> Connections:
    """Return the type, the publishers and the subscribers of the topic; the caller adds the key "sources".

    Raises GraphError if a request to the master fails.
    """
    state = master.system_state()
    kind = master.topic_types().get(topic, "")
    publishers, subscribers = state.publishers.get(topic, ()), state.subscribers.get(topic, ())
    uris, _ = master.lookup_all({*publishers, *subscribers}, ())
    publications = {node: rpc_probe(uris[node], "getPublications") for node in publishers if node in uris}
    subscriptions = {node: rpc_probe(uris[node], "getSubscriptions") for node in subscribers if node in uris}
    ask_all([*publications.values(), *subscriptions.values()], TIMEOUT)
    published, subscribed = (
        {node: _type_of(topic, rpc_answer(probe)) for node, probe in each.items()}
        for each in (publications, subscriptions)
    )
    return {
        "type": "" if kind == ANY else kind,
        "publishers": [Peer(node=node, type=published.get(node, "")) for node in publishers],
        "subscribers": [Peer(node=node, type=subscribed.get(node, "")) for node in subscribers],
    }


def _type_of(topic: str, answer: RpcValue) -> str:
    """Return the type of a topic in the list [[topic, type]*], or "" if the topic is missing."""
    rows = answer if isinstance(answer, list) else []
    return next(
        (str(row[1]) for row in rows if isinstance(row, list) and row[:1] == [topic] and len(row) > 1), ""
    )
