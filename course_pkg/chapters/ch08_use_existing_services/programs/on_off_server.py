"""The node `on_off_server`: offers the service `on_off`, which returns OFF for 0 and ON for 1."""

from __future__ import annotations

import rospy

from course_pkg.ros.node.program import serve_until_shutdown
from course_pkg.srv import ServiceExample, ServiceExampleRequest, ServiceExampleResponse

STATES = ("OFF", "ON")


def main() -> None:
    """Serve until the node is shut down."""
    serve_until_shutdown("on_off_server", {"on_off": (ServiceExample, name_state)})


def name_state(request: ServiceExampleRequest) -> ServiceExampleResponse:
    """Return OFF for 0 and ON for 1; raises ServiceException for any other number."""
    if request.number not in range(len(STATES)):
        rospy.logwarn("Refused: %d", request.number)
        raise rospy.ServiceException(f"{request.number} is neither 0 (OFF) nor 1 (ON)")
    state = STATES[request.number]
    rospy.loginfo("%d: %s", request.number, state)
    return ServiceExampleResponse(state=state)
