"""The node `client`: calls `getGeometry` with the sides of a box, and prints the response."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.errors import CourseError
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.srv import geometry

TIMEOUT = 5.0  # s to wait for the server, and again for its answer
USAGE = "usage: client LENGTH WIDTH HEIGHT   (three numbers, in metres, such as 1.2 5.2 8.9)"


def main() -> None:
    """Measure the box of the command line; exit with 1 if the call fails, with 2 for wrong arguments."""
    sides = read_sides(rospy.myargv(sys.argv)[1:])
    if sides is None:
        sys.exit(_error(USAGE, 2))
    try:
        print(measure(sides))  # noqa: T201 -- the program's answer
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        sys.exit(_error(str(error), 1))
    except OverflowError:
        sys.exit(_error(f"{max(sides, key=abs):g} is more than a float32 can hold.", 2))


def read_sides(arguments: Sequence[str]) -> tuple[float, float, float] | None:
    """Return length, width and height, or None if the arguments are not three numbers."""
    try:
        length, width, height = map(float, arguments)
    except ValueError:
        return None
    return length, width, height


def measure(sides: tuple[float, float, float]) -> str:
    """Start the node, wait for the service, call it, and return its response as two lines.

    Raises ROSException if no server comes in time, ServiceException if the call fails, CallTimeout, and
    MasterUnreachable.
    """
    MasterClient(master_uri()).pid()  # init_node would wait for a master without a limit
    rospy.init_node("client", anonymous=True)
    prepare_node()
    rospy.wait_for_service("getGeometry", timeout=TIMEOUT)
    response = BoundedProxy("getGeometry", geometry, timeout=TIMEOUT)(*sides)
    return f"area: {response.area:.2f}\nvolume: {response.volume:.2f}"


def _error(message: str, status: int) -> int:
    sys.stderr.write(f"{message}\n")
    return status
