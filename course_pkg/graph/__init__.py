"""The ROS graph: find or start a master, join as a node, run nodes, call in bounded time, see what is there.

The names are looked up on first use: `course` starts a master before it can import rospy.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from course_pkg.graph.calls import BoundedProxy
    from course_pkg.graph.handshake import guard_against_idle_connections
    from course_pkg.graph.heard import Heard
    from course_pkg.graph.joining import join
    from course_pkg.graph.leash import Leash
    from course_pkg.graph.master import PrivateMaster, find_or_start_master, master_uri
    from course_pkg.graph.node import Node
    from course_pkg.graph.processes import NodeProcess
    from course_pkg.graph.rpc import MasterClient, SystemState
    from course_pkg.graph.served import Served, ServedCall
    from course_pkg.graph.snapshot import NodeSeen, ServiceSeen, Snapshot, TopicSeen, look
    from course_pkg.graph.stale import StaleRegistration, remove_stale, stale_registrations

__all__ = [
    "BoundedProxy",
    "Heard",
    "Leash",
    "MasterClient",
    "Node",
    "NodeProcess",
    "NodeSeen",
    "PrivateMaster",
    "Served",
    "ServedCall",
    "ServiceSeen",
    "Snapshot",
    "StaleRegistration",
    "SystemState",
    "TopicSeen",
    "find_or_start_master",
    "guard_against_idle_connections",
    "join",
    "look",
    "master_uri",
    "remove_stale",
    "stale_registrations",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401 -- PEP 562: a module's attribute is of any type
    homes = {
        "BoundedProxy": "calls",
        "Heard": "heard",
        "Leash": "leash",
        "MasterClient": "rpc",
        "Node": "node",
        "NodeProcess": "processes",
        "NodeSeen": "snapshot",
        "PrivateMaster": "master",
        "Served": "served",
        "ServedCall": "served",
        "ServiceSeen": "snapshot",
        "Snapshot": "snapshot",
        "StaleRegistration": "stale",
        "SystemState": "rpc",
        "TopicSeen": "snapshot",
        "find_or_start_master": "master",
        "guard_against_idle_connections": "handshake",
        "join": "joining",
        "look": "snapshot",
        "master_uri": "master",
        "remove_stale": "stale",
        "stale_registrations": "stale",
    }
    if name not in homes:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{homes[name]}"), name)
