"""What a user should know about the graph of a command."""

from __future__ import annotations

from course_pkg.lab.graph.graph import Graph, Which
from course_pkg.lab.graph.outgoing import WITHOUT, problem

EXPOSED = (
    "The graph uses the network of this computer: everybody who can log in here can call, replace and stop "
    "your nodes."
)


def notes(graph: Graph, which: Which) -> str:
    """Return sentences about the limits of the graph, each on its own line, or an empty string."""
    if which is Which.SHARED:
        return f"{EXPOSED}\n"
    if graph.reason:
        return f"This computer does not allow a private network ({graph.reason}). {EXPOSED}\n"
    return (
        ""
        if graph.outgoing or not graph.files
        else WITHOUT.format(problem=problem() or "slirp4netns has failed") + "\n"
    )
