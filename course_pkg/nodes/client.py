"""The node `client`: has a box measured by `getGeometry`, and prints what comes back."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.errors import CourseError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.master import master_uri
from course_pkg.graph.preparation import prepare_node
from course_pkg.graph.rpc import MasterClient
from course_pkg.srv import geometry

PATIENCE = 5.0  # s to wait for the server, and again for its answer
USAGE = "usage: client LENGTH WIDTH HEIGHT   (three numbers, in metres, such as 1.2 5.2 8.9)"


def main() -> None:
    """Measure the box of the command line; exit with 1 when nobody does, with 2 for a wrong line."""
    sides = read_sides(rospy.myargv(sys.argv)[1:])
    if sides is None:
        sys.exit(_complaint(USAGE, 2))
    try:
        print(ask(sides))  # noqa: T201 -- the program's answer
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        sys.exit(_complaint(str(error), 1))
    except OverflowError:
        sys.exit(_complaint(f"{max(sides, key=abs):g} is more than a float32 can hold.", 2))


def read_sides(words: Sequence[str]) -> tuple[float, float, float] | None:
    """Return length, width and height, or None when the words are not three numbers."""
    try:
        length, width, height = map(float, words)
    except ValueError:
        return None
    return length, width, height


def ask(sides: tuple[float, float, float]) -> str:
    """Join the graph, wait for the server, and return its answer as two lines of text."""
    MasterClient(master_uri()).pid()  # init_node would wait for a master for ever
    rospy.init_node("client", anonymous=True)
    prepare_node()
    rospy.wait_for_service("getGeometry", timeout=PATIENCE)
    response = BoundedProxy("getGeometry", geometry, timeout=PATIENCE)(*sides)
    return f"area: {response.area:.2f}\nvolume: {response.volume:.2f}"


def _complaint(words: str, status: int) -> int:
    sys.stderr.write(f"{words}\n")
    return status
