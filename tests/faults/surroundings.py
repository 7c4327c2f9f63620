"""What a fault must leave as it found it: the graph, processes, listening ports, the environment."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

from course_pkg.graph import Snapshot, look
from course_pkg.graph.leashed import descendants
from course_pkg.graph.ports import family, listening_ports


@dataclass(frozen=True)
class Surroundings:
    """All of it at one moment, with the graph of ROS_MASTER_URI."""

    graph: Snapshot = field(default_factory=look)
    processes: frozenset[int] = field(default_factory=lambda: frozenset(descendants(os.getpid())))
    ports: frozenset[int] = field(default_factory=lambda: listening_ports(family(os.getpid())) or frozenset())
    environment: dict[str, str] = field(default_factory=lambda: dict(os.environ))

    def left_behind(self) -> dict[str, object]:
        """Return what is different now. A process that others started may end meanwhile."""
        now = Surroundings()
        left = {
            "graph": now.graph if now.graph != self.graph else None,
            "processes": now.processes - self.processes,
            "ports": now.ports ^ self.ports,
            "environment": dict(set(now.environment.items()) ^ set(self.environment.items())),
        }
        return {name: what for name, what in left.items() if what}
