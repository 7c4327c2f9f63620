"""Send the record of a node to other nodes before the node ends.

Otherwise, a recording would not include nodes that run only for a short time. A node that makes a recording
stores its address in a parameter of the master. A node that ends sends its record by XML-RPC to this address.
A killed node cannot send its record.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import rospy
from rospy.impl.masterslave import ROSHandler

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.rospy_registrations import registration_manager
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, XmlRpcClient
from course_pkg.ros.trace.recorder import recorder

KEEP = "keepCourseRecord"
PARAMETER = "/course_recorders"
TIMEOUT = 0.5  # Each call takes at most this time in s. A longer call would delay the end of a node.
LONGEST = 600.0  # A node that ends sends its record of the last 600 s.
# This attribute marks the registration manager of a node that sends its record when it ends.
PREPARED = "prepared_for_handover_by_course"


def hand_over_at_exit() -> None:
    """Make this process's node send its record when it ends, and accept records from other nodes."""
    setattr(ROSHandler, KEEP, _keep)
    manager = registration_manager()
    if manager is not None and not getattr(manager, PREPARED, False):
        setattr(manager, PREPARED, True)
        # The master's address is None if leave() has already sent the record, or if the master did not
        # answer.
        rospy.core.add_shutdown_hook(lambda _reason: hand_over() if manager.master_uri else None)


@contextmanager
def handovers(node: str, uri: str, master: MasterClient) -> Iterator[None]:
    """During the `with` block, let each node that ends send its record to the node at the address `uri`."""
    parameter = f"{PARAMETER}{node}_{next(recorder().numbers)}"
    own, announced = recorder(), False
    own.recordings += 1
    with suppress(GraphError):  # The master may have ended.
        announced = master.set_param(parameter, uri, timeout=TIMEOUT)
    try:
        yield
    finally:
        own.recordings -= 1
        if not own.recordings:
            own.handed_over.clear()
        if announced:
            with suppress(GraphError):
                master.delete_param(parameter, timeout=TIMEOUT)


def hand_over() -> None:
    """Send this node's record to all nodes that are making a recording."""
    with suppress(GraphError):
        recorders = MasterClient(master_uri(), TIMEOUT).get_param(PARAMETER, {})
        found = recorders.values() if isinstance(recorders, dict) else ()
        uris = {uri for uri in found if isinstance(uri, str)}
        for uri in uris - {rospy.get_node_uri()}:
            _hand_over(uri)


def _hand_over(uri: str) -> None:
    record = json.dumps(recorder().since(time.monotonic() - LONGEST))
    # The node that makes the recording may have ended. Another program may use the port now and send an
    # invalid response.
    with suppress(OSError, *NO_ANSWER):
        XmlRpcClient(uri, TIMEOUT).ask(KEEP, "/course", rospy.get_name(), record)


def _keep(_handler: ROSHandler, _caller_id: str, node: str, record: str) -> tuple[int, str, int]:
    """Accept the record of a node that ends, if this process is making a recording."""
    if not recorder().recordings:
        return 0, "this process makes no recording", 0
    recorder().handed_over.append((str(node), json.loads(record)))
    return 1, "", 0
