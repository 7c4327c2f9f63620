"""The ROS graph: find or start a master, join as a node, run nodes, call in bounded time, see what is there.

The names are looked up on first use: `course` starts a master before it can import rospy.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.graph.activity import Activity, Carried, Listener, listen
    from course_pkg.graph.callers import ServiceCaller, service_callers
    from course_pkg.graph.calls import BoundedProxy
    from course_pkg.graph.events import Event
    from course_pkg.graph.handshake import guard_against_idle_connections
    from course_pkg.graph.heard import Heard
    from course_pkg.graph.island import Island
    from course_pkg.graph.joining import join, this_node
    from course_pkg.graph.leash import Leash
    from course_pkg.graph.master import PrivateMaster, find_or_start_master, master_uri
    from course_pkg.graph.node import Node
    from course_pkg.graph.preparation import prepare_node
    from course_pkg.graph.processes import NodeProcess
    from course_pkg.graph.recording import Recording
    from course_pkg.graph.rpc import MasterClient, SystemState
    from course_pkg.graph.served import Served, ServedCall
    from course_pkg.graph.snapshot import NodeSeen, ServiceSeen, Snapshot, TopicSeen, look
    from course_pkg.graph.spoken import Spoken
    from course_pkg.graph.stale import StaleRegistration, remove_stale, stale_registrations
    from course_pkg.graph.wiretap import Wire, Wiretap, record_call

__all__ = [
    "Activity",
    "BoundedProxy",
    "Carried",
    "Event",
    "Heard",
    "Island",
    "Leash",
    "Listener",
    "MasterClient",
    "Node",
    "NodeProcess",
    "NodeSeen",
    "PrivateMaster",
    "Recording",
    "Served",
    "ServedCall",
    "ServiceCaller",
    "ServiceSeen",
    "Snapshot",
    "Spoken",
    "StaleRegistration",
    "SystemState",
    "TopicSeen",
    "Wire",
    "Wiretap",
    "find_or_start_master",
    "guard_against_idle_connections",
    "join",
    "listen",
    "look",
    "master_uri",
    "prepare_node",
    "record_call",
    "remove_stale",
    "service_callers",
    "stale_registrations",
    "this_node",
]

__getattr__ = lazily(
    __name__,
    {
        "activity": "Activity Carried Listener listen",
        "callers": "ServiceCaller service_callers",
        "calls": "BoundedProxy",
        "events": "Event",
        "handshake": "guard_against_idle_connections",
        "heard": "Heard",
        "island": "Island",
        "joining": "join this_node",
        "leash": "Leash",
        "master": "PrivateMaster find_or_start_master master_uri",
        "node": "Node",
        "preparation": "prepare_node",
        "processes": "NodeProcess",
        "recording": "Recording",
        "rpc": "MasterClient SystemState",
        "served": "Served ServedCall",
        "snapshot": "NodeSeen ServiceSeen Snapshot TopicSeen look",
        "spoken": "Spoken",
        "stale": "StaleRegistration remove_stale stale_registrations",
        "wiretap": "Wire Wiretap record_call",
    },
)
