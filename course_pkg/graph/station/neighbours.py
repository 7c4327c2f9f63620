"""Who publishes and who subscribes to a topic now, and of which type each of them says that it is.

The master knows one type of a topic, that of whoever came first. Each node knows its own: getPublications and
getSubscriptions, http://wiki.ros.org/ROS/Slave_API.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from course_pkg.graph.probe import ask_all, rpc_answer, rpc_probe
from course_pkg.graph.rpc import MasterClient

PATIENCE = 0.5  # s for the nodes to answer
ANY = "*"  # what a subscriber says that takes every type, such as `rostopic echo`


@dataclass(frozen=True)
class Neighbour:
    """A node on the topic; `type` is "" when it does not answer."""

    node: str
    type: str


@dataclass(frozen=True)
class Neighbourhood:
    """A topic: its type as the master has it ("" for none), who publishes it, and who subscribes."""

    type: str
    publishers: tuple[Neighbour, ...]
    subscribers: tuple[Neighbour, ...]

    def as_dict(self) -> dict[str, Any]:
        """Return it as plain data, fit for JSON."""
        return asdict(self)


def look_around(master: MasterClient, topic: str) -> Neighbourhood:
    """Return who is on the topic. Raises what MasterClient raises."""
    state = master.system_state()
    kind = master.topic_types().get(topic, "")
    publishers, subscribers = state.publishers.get(topic, ()), state.subscribers.get(topic, ())
    uris, _ = master.lookup_all({*publishers, *subscribers}, ())
    published = {node: rpc_probe(uris[node], "getPublications") for node in publishers if node in uris}
    heard = {node: rpc_probe(uris[node], "getSubscriptions") for node in subscribers if node in uris}
    ask_all([*published.values(), *heard.values()], PATIENCE)
    said = [
        {node: _type_of(topic, rpc_answer(probe)) for node, probe in each.items()}
        for each in (published, heard)
    ]
    return Neighbourhood(
        "" if kind == ANY else kind,
        tuple(Neighbour(node, said[0].get(node, "")) for node in publishers),
        tuple(Neighbour(node, said[1].get(node, "")) for node in subscribers),
    )


def _type_of(topic: str, answer: Any) -> str:  # noqa: ANN401 -- what a node answers
    """Return the type of a topic among [[topic, type]*]."""
    rows = answer if isinstance(answer, list) else []
    return next(
        (str(row[1]) for row in rows if isinstance(row, list) and row[:1] == [topic] and len(row) > 1), ""
    )
