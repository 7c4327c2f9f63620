"""Who has called which service, as their servers count it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from course_pkg.graph.probe import Probe, ask_all, rpc_answer, rpc_probe

PATIENCE = 0.5  # s
QUESTION = "getBusStats"  # its third part is for services; rospy itself leaves it empty

Callers = dict[str, tuple["ServiceCaller", ...]]


@dataclass(frozen=True)
class ServiceCaller:
    """A node that has called a service since the server started.

    `calls` counts the requests that reached it, `last` is when the latest did (s since the epoch), and
    `running` how many a handler is working on: while that is not 0, the caller waits.
    """

    node: str
    calls: int
    last: float
    running: int


def service_callers(nodes: Mapping[str, str], timeout: float = PATIENCE) -> Callers:
    """Return who has called each service of `nodes` (name -> http:// address), the latest caller first.

    All are asked at once, for at most `timeout` s. A service whose server does not count its callers (a C++
    node, one that is not of the course, or that is silent) is missing; () means that nobody has called yet.
    """
    probes = [callers_probe(uri) for uri in nodes.values()]
    ask_all(probes, timeout)
    return {name: callers for probe in probes for name, callers in told_callers(probe).items()}


def callers_probe(uri: str) -> Probe:
    """Return a probe that asks the node at `uri`, for a round of ask_all()."""
    return rpc_probe(uri, QUESTION)


def told_callers(probe: Probe) -> Callers:
    """Return what the node has told, by service; nothing if it has not."""
    stats = rpc_answer(probe)
    if not (isinstance(stats, list) and len(stats) == 3 and isinstance(stats[2], list)):
        return {}
    return {str(name): tuple(ServiceCaller(*each) for each in callers) for name, callers in stats[2]}
