"""Compares the state of the machine before and after a fault: ROS graph, processes, ports and environment."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

from course_pkg.ros import Snapshot, look
from course_pkg.ros.process.supervised import listening_ports
from course_pkg.ros.process.supervisor import descendants


@dataclass(frozen=True)
class Surroundings:
    """The state of the machine at one moment, with the ROS graph of the master at ROS_MASTER_URI."""

    graph: Snapshot = field(default_factory=look)
    processes: frozenset[int] = field(default_factory=lambda: frozenset(descendants(os.getpid())))
    ports: frozenset[int] = field(default_factory=lambda: listening_ports(os.getpid()))
    environment: dict[str, str] = field(default_factory=lambda: dict(os.environ))

    def left_behind(self) -> dict[str, object]:
        """Return the differences between the stored state and the current state.

        The function ignores new child processes of a process that already existed.
        """
        now = Surroundings()
        others = {pid for before in self.processes for pid in descendants(before)}
        left = {
            "graph": now.graph if now.graph != self.graph else None,
            "processes": now.processes - self.processes - others,
            "ports": now.ports ^ self.ports,
            "environment": dict(set(now.environment.items()) ^ set(self.environment.items())),
        }
        return {name: what for name, what in left.items() if what}
