"""The node `session_server`: offers the service `add_up`, which has a separate total for each session.

A request does not contain the name of its sender. Therefore, a client writes the name of its session into the
field `session` of the connection header. A header may contain any field
(http://wiki.ros.org/ROS/Connection%20Header), and rospy passes all fields to the handler.
"""

from __future__ import annotations

import threading

import rospy

from course_pkg.ros.node.program import serve_until_shutdown
from course_pkg.srv import AddUp, AddUpRequest, AddUpResponse

FIELD = "session"
LARGEST = 2**31 - 1  # LARGEST is the maximum value of an int32.
# At most this many sessions are stored. A new session replaces the session that has been unused for the
# longest time.
MOST = 1000


class Sessions:
    """The totals of all sessions; a lock protects them, because rospy handles each call on its own thread."""

    def __init__(self) -> None:
        # The dict maps each session to its total and its number of calls; the session with the latest call is
        # the last item.
        self._totals: dict[str, tuple[int, int]] = {}
        self._lock = threading.Lock()

    def add_up(self, request: AddUpRequest) -> AddUpResponse:
        """Add the amount and return the total of the session.

        Raises ServiceException if the connection header has no session, or if the total does not fit into an
        int32.
        """
        session = request._connection_header.get(FIELD, "")  # type: ignore[attr-defined] # rospy adds it
        if not session:
            raise rospy.ServiceException(
                f"the connection header has no field {FIELD}, so the total is unknown"
            )
        with self._lock:
            total, calls = self._totals.get(session, (0, 0))
            total += request.amount
            if abs(total) > LARGEST:
                raise rospy.ServiceException(f"{total} is more than an int32 can hold")
            self._totals.pop(session, None)
            self._totals[session] = total, calls + 1
            while len(self._totals) > MOST:
                del self._totals[next(iter(self._totals))]
        return AddUpResponse(total=total, calls=calls + 1)


def main() -> None:
    """Serve until the node is shut down."""
    serve_until_shutdown("session_server", {"add_up": (AddUp, Sessions().add_up)})
