"""What a node that ends leaves to those who record, so that a client of a second's life is in the recording.

Who records says so by a parameter of the master, for as long as it records; a node that ends hands its record
over there, by the XML-RPC interface that every node has. A node that is killed cannot.
"""

from __future__ import annotations

import http.client
import json
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from xml.parsers.expat import ExpatError
from xmlrpc.client import Error, ServerProxy, Transport

import rospy
from rospy.impl.masterslave import ROSHandler

from course_pkg.errors import GraphError
from course_pkg.graph.master import master_uri
from course_pkg.graph.registrar import registration_manager
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.trace import recorder

KEEP = "keepCourseRecord"
PARAMETER = "/course_recorders"
PATIENCE = 0.5  # s for each question, so that no node's end is held up
LONGEST = 600.0  # s of its past that a node hands over
ASKED = "asked_for_farewell_by_course"  # an attribute of a registrar whose node will say farewell


def say_farewell_at_the_end() -> None:
    """Have this process's node hand its record over when it ends, and take in those of others."""
    setattr(ROSHandler, KEEP, _keep)
    manager = registration_manager()
    if manager is not None and not getattr(manager, ASKED, False):
        setattr(manager, ASKED, True)
        # Without an address, the node has left the graph before, or its master does not answer.
        rospy.core.add_shutdown_hook(lambda _reason: say_farewell() if manager.master_uri else None)


@contextmanager
def farewells(node: str, uri: str, master: MasterClient) -> Iterator[None]:
    """Have nodes that end during the block hand their records over to the node at `uri`."""
    parameter = f"{PARAMETER}{node}_{next(recorder().numbers)}"
    own, asked = recorder(), False
    own.recordings += 1
    with suppress(GraphError):  # a master that is gone has nothing to tell anybody
        asked = master.set_param(parameter, uri, timeout=PATIENCE)
    try:
        yield
    finally:
        own.recordings -= 1
        if not own.recordings:
            own.left.clear()
        if asked:
            with suppress(GraphError):
                master.delete_param(parameter, timeout=PATIENCE)


def say_farewell() -> None:
    """Hand this node's record over to those who record, if there are any."""
    with suppress(GraphError):
        asked = MasterClient(master_uri(), PATIENCE).get_param(PARAMETER, {})
        uris = {uri for uri in asked.values() if isinstance(uri, str)} if isinstance(asked, dict) else set()
        for uri in uris - {rospy.get_node_uri()}:
            _hand_over(uri)


def _hand_over(uri: str) -> None:
    record = json.dumps(recorder().since(time.monotonic() - LONGEST))
    # Who recorded may be gone, and its port be anybody's.
    with suppress(OSError, http.client.HTTPException, Error, ExpatError, ValueError):
        getattr(ServerProxy(uri, transport=_Bounded()), KEEP)("/course", rospy.get_name(), record)


def _keep(_handler: ROSHandler, _caller_id: str, node: str, record: str) -> tuple[int, str, int]:
    """Take in the record of a node that ends, while there is a recording that it may belong to."""
    if not recorder().recordings:
        return 0, "nobody records here", 0
    recorder().left.append((str(node), json.loads(record)))
    return 1, "", 0


class _Bounded(Transport):
    """A way to a node on which nothing takes longer than the patience."""

    def make_connection(self, host: object) -> http.client.HTTPConnection:
        """Connect, with a limit."""
        connection = super().make_connection(host)  # type: ignore[arg-type]
        connection.timeout = PATIENCE
        return connection
