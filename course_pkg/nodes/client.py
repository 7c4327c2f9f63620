"""The node `client`. It calls the service `getGeometry` with the sides of a box, and prints the response."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.errors import CourseError
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.srv import geometry

# the client waits at most this time in s for the service, and then at most this time for the response
TIMEOUT = 5.0
USAGE = "usage: client LENGTH WIDTH HEIGHT   (three numbers, in metres, such as 1.2 5.2 8.9)"


def main() -> None:
    """Call the service with the sides from the command line, and print the response.

    Exits with status 1 if the call fails, and with status 2 if the arguments are wrong.
    """
    sides = read_sides(rospy.myargv(sys.argv)[1:])
    if sides is None:
        sys.exit(_error(USAGE, 2))
    try:
        print(measure(sides))  # noqa: T201 -- the output of the program
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        sys.exit(_error(str(error), 1))
    except OverflowError:
        sys.exit(_error(f"{max(sides, key=abs):g} does not fit into a float32. Give a smaller number.", 2))


def read_sides(arguments: Sequence[str]) -> tuple[float, float, float] | None:
    """Return the length, width and height, or None if the arguments are not three numbers."""
    try:
        length, width, height = map(float, arguments)
    except ValueError:
        return None
    return length, width, height


def measure(sides: tuple[float, float, float]) -> str:
    """Start the node, wait for the service, call it, and return its response as two lines.

    Raises MasterUnreachable if there is no master, and ServiceException if the call fails. Raises
    ROSException if the service does not exist within `TIMEOUT` seconds, and CallTimeout if the response does
    not arrive within `TIMEOUT` seconds.
    """
    # This call raises an error if no master answers; init_node would wait for ever.
    MasterClient(master_uri()).pid()
    rospy.init_node("client", anonymous=True)
    prepare_node()
    rospy.wait_for_service("getGeometry", timeout=TIMEOUT)
    response = BoundedProxy("getGeometry", geometry, timeout=TIMEOUT)(*sides)
    return f"area: {response.area:.2f}\nvolume: {response.volume:.2f}"


def _error(message: str, status: int) -> int:
    sys.stderr.write(f"{message}\n")
    return status
