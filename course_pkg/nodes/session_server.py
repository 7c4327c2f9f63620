"""The node `session_server`: adds up for each of its clients apart, as the service `add_up`.

Who is calling stands in no request: a client names its session in the connection header, as the field
`session`. http://wiki.ros.org/ROS/Connection%20Header allows any field; rospy hands all of them on.
"""

from __future__ import annotations

import threading
from typing import Any

import rospy

from course_pkg.graph.program import serve_until_shutdown
from course_pkg.srv import AddUp, AddUpResponse

FIELD = "session"
LARGEST = 2**31 - 1  # that an int32 holds
MOST = 1000  # sessions; the one that was quiet for longest makes room


class Sessions:
    """The totals of all sessions; each call has a thread of its own, so they take turns."""

    def __init__(self) -> None:
        self._totals: dict[str, tuple[int, int]] = {}  # total and calls, who called last at the end
        self._turn = threading.Lock()

    def add_up(self, request: Any) -> AddUpResponse:  # noqa: ANN401 -- a class that catkin generates
        """Return the session's total, with the amount in it; a client without a session is refused."""
        session = request._connection_header.get(FIELD, "")
        if not session:
            raise rospy.ServiceException(f"the connection header has no field {FIELD}: whose total is it?")
        with self._turn:
            total, calls = self._totals.get(session, (0, 0))
            total += request.amount
            if abs(total) > LARGEST:
                raise rospy.ServiceException(f"{total} is more than an int32 can hold")
            self._totals.pop(session, None)
            self._totals[session] = total, calls + 1
            while len(self._totals) > MOST:
                del self._totals[next(iter(self._totals))]
        return AddUpResponse(total=total, calls=calls + 1)  # type: ignore[no-untyped-call]


def main() -> None:
    """Serve until the node is shut down."""
    serve_until_shutdown("session_server", {"add_up": (AddUp, Sessions().add_up)})
