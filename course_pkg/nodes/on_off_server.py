"""The node `on_off_server`: takes 0 or 1 on the service `on_off`, and says OFF or ON."""

from __future__ import annotations

from typing import Any

import rospy

from course_pkg.graph.program import serve_until_shutdown
from course_pkg.srv import ServiceExample, ServiceExampleResponse

STATES = ("OFF", "ON")


def main() -> None:
    """Serve until the node is shut down."""
    serve_until_shutdown("on_off_server", {"on_off": (ServiceExample, name_state)})


def name_state(request: Any) -> ServiceExampleResponse:  # noqa: ANN401 -- a class that catkin generates
    """Return OFF for 0 and ON for 1; any other number is refused."""
    if request.number not in range(len(STATES)):
        rospy.logwarn("Refused: %d", request.number)
        raise rospy.ServiceException(f"{request.number} is neither 0 (OFF) nor 1 (ON)")
    state = STATES[request.number]
    rospy.loginfo("%d: %s", request.number, state)
    return ServiceExampleResponse(state=state)  # type: ignore[no-untyped-call]
