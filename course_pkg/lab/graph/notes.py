"""The message to the user about the limits of a command's graph."""

from __future__ import annotations

from course_pkg.lab.graph.graph import Graph, Which
from course_pkg.setup.network import FORWARDER, outgoing_problem

EXPOSED = (
    "The graph uses the network of this computer. All users who can log in on this computer "
    "can call, replace and stop your nodes."
)
ADVICE = "Run `./course doctor` to see what to do."
UNREACHABLE = (
    "Programs on this graph, such as `git push` and `pip`, cannot reach other computers ({problem}). "
    f"{ADVICE} With `--shared-graph`, the graph uses the network of this computer."
)


def notes(graph: Graph, which: Which) -> str:
    """Return a line about the limits of the graph, or an empty string."""
    if which is Which.SHARED:
        return f"{EXPOSED}\n"
    if graph.reason:
        return f"This computer allows no private network ({graph.reason}). {EXPOSED} {ADVICE}\n"
    problem, _ = outgoing_problem()
    if graph.files and (problem or not graph.outgoing):
        return UNREACHABLE.format(problem=problem or f"{FORWARDER} failed") + "\n"
    return ""
