"""The node `add_two_ints_server`: offers the service `add_two_ints`, which adds two whole numbers."""

from __future__ import annotations

import rospy

from course_pkg.ros.node.program import serve_until_shutdown
from course_pkg.srv import AddTwoInts, AddTwoIntsRequest, AddTwoIntsResponse

LARGEST = 2**63 - 1  # LARGEST is the largest int64; the smallest is -LARGEST - 1.


def main() -> None:
    """Serve until the node is shut down."""
    serve_until_shutdown("add_two_ints_server", {"add_two_ints": (AddTwoInts, add)})


def add(request: AddTwoIntsRequest) -> AddTwoIntsResponse:
    """Return a + b; raises ServiceException if the sum is out of the range of an int64."""
    total = request.a + request.b
    if not -LARGEST - 1 <= total <= LARGEST:
        raise rospy.ServiceException(f"{total} is more than an int64 can hold")
    rospy.loginfo("%d + %d = %d", request.a, request.b, total)
    return AddTwoIntsResponse(sum=total)
