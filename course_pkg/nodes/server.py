"""The node `SERVER_NODE`: measures boxes, as the service `getGeometry`."""

from __future__ import annotations

import math
from typing import Any

import rospy

from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import step_onto_graph
from course_pkg.srv import geometry, geometryResponse


def main() -> None:
    """Serve until the node is shut down."""
    if not step_onto_graph("SERVER_NODE"):
        return
    with undisturbed():
        service = rospy.Service("getGeometry", geometry, measure)
        rospy.loginfo("Ready to measure boxes on %s", service.resolved_name)
    rospy.spin()


def measure(request: Any) -> geometryResponse:  # noqa: ANN401 -- a class that catkin generates
    """Return area = width x length and volume = area x height; a side that no box has is refused."""
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0 or not math.isfinite(value):
            rospy.logwarn("Refused: %s is %g", side, value)
            raise rospy.ServiceException(f"{side} is {value:g}, and a side is finite and not negative")
    area = request.width * request.length
    response = geometryResponse(area=area, volume=area * request.height)  # type: ignore[no-untyped-call]
    sides = (request.length, request.width, request.height)
    rospy.loginfo("%g x %g x %g: area %g, volume %g", *sides, response.area, response.volume)
    return response
