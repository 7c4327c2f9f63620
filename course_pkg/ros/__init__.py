"""Work with the ROS graph.

The modules find or start a master, make this process a node, run other nodes, call services with a time
limit, and list all nodes.

Each name of this package is imported at its first use: the program `course` has to start a master before it
can import rospy.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.ros.node.join import join, this_node
    from course_pkg.ros.node.node import Node
    from course_pkg.ros.node.preparation import guard_against_idle_connections, prepare_node
    from course_pkg.ros.node.proxy import BoundedProxy
    from course_pkg.ros.node.publisher import Publisher
    from course_pkg.ros.node.subscription import Subscription
    from course_pkg.ros.process.master import PrivateMaster
    from course_pkg.ros.process.node_process import NodeProcess
    from course_pkg.ros.process.private_graph import PrivateGraph
    from course_pkg.ros.process.roscore import Roscore, find_or_start_master
    from course_pkg.ros.process.supervised import SupervisedProcess
    from course_pkg.ros.protocol.master_api import MasterClient, SystemState, master_uri
    from course_pkg.ros.protocol.registrations import Registration, remove_stale
    from course_pkg.ros.protocol.snapshot import NodeSeen, ServiceSeen, Snapshot, TopicSeen, look
    from course_pkg.ros.trace.activity import (
        Activity,
        ActivityPoller,
        ServiceCaller,
        Traffic,
    )
    from course_pkg.ros.trace.recording import Event, Recording
    from course_pkg.ros.wire.capture import Wire, record_call

__all__ = [
    "Activity",
    "ActivityPoller",
    "BoundedProxy",
    "Event",
    "MasterClient",
    "Node",
    "NodeProcess",
    "NodeSeen",
    "PrivateGraph",
    "PrivateMaster",
    "Publisher",
    "Recording",
    "Registration",
    "Roscore",
    "ServiceCaller",
    "ServiceSeen",
    "Snapshot",
    "Subscription",
    "SupervisedProcess",
    "SystemState",
    "TopicSeen",
    "Traffic",
    "Wire",
    "find_or_start_master",
    "guard_against_idle_connections",
    "join",
    "look",
    "master_uri",
    "prepare_node",
    "record_call",
    "remove_stale",
    "this_node",
]

__getattr__ = lazily(
    __name__,
    {
        "trace.activity": "Activity ActivityPoller ServiceCaller Traffic",
        "node.proxy": "BoundedProxy",
        "node.subscription": "Subscription",
        "process.private_graph": "PrivateGraph",
        "node.join": "join this_node",
        "process.supervised": "SupervisedProcess",
        "process.master": "PrivateMaster",
        "process.roscore": "Roscore find_or_start_master",
        "node.node": "Node",
        "node.preparation": "guard_against_idle_connections prepare_node",
        "process.node_process": "NodeProcess",
        "trace.recording": "Event Recording",
        "protocol.master_api": "MasterClient SystemState master_uri",
        "protocol.snapshot": "NodeSeen ServiceSeen Snapshot TopicSeen look",
        "node.publisher": "Publisher",
        "protocol.registrations": "Registration remove_stale",
        "wire.capture": "Wire record_call",
    },
)
