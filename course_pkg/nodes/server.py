"""The node `SERVER_NODE`: its service `getGeometry` returns the area and the volume of a box."""

from __future__ import annotations

import math

import rospy

from course_pkg.ros.node.program import start_node, undisturbed
from course_pkg.srv import geometry, geometryRequest, geometryResponse


def main() -> None:
    """Provide the service until the node is shut down."""
    if not start_node("SERVER_NODE"):
        return
    with undisturbed():
        service = rospy.Service("getGeometry", geometry, measure)
        rospy.loginfo("Ready to measure boxes on %s", service.resolved_name)
    rospy.spin()


def measure(request: geometryRequest) -> geometryResponse:
    """Return area = width x length (m²) and volume = area x height (m³).

    Raises ServiceException if a side is negative or not finite.
    """
    for side in ("length", "width", "height"):
        value = getattr(request, side)
        if value < 0 or not math.isfinite(value):
            rospy.logwarn("Refused: %s is %g", side, value)
            raise rospy.ServiceException(f"{side} is {value:g}, but has to be finite and not negative")
    area = request.width * request.length
    response = geometryResponse(area=area, volume=area * request.height)
    sides = (request.length, request.width, request.height)
    rospy.loginfo("%g x %g x %g: area %g, volume %g", *sides, response.area, response.volume)
    return response
