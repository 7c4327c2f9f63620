"""The node `session_client`: adds amounts in one session of the service `add_up`."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.chapters.ch11_look_inside.programs.session_server import FIELD
from course_pkg.errors import CourseError
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.node.program import TIMEOUT, complain, number_parameter
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.srv import AddUp

USAGE = (
    "usage: session_client SESSION AMOUNT…   (example: session_client alice 5 "
    "10)\nWith _rate:=2, the program repeats all amounts until Ctrl-C, with two calls per "
    "second."
)


def main() -> None:
    """Print the total after each amount; the exit status is 1 if a call fails, and 2 for wrong arguments."""
    arguments = read_arguments(rospy.myargv(sys.argv)[1:])
    if arguments is None:
        sys.exit(complain(USAGE, 2))
    try:
        _add_up(*arguments)
    except rospy.ROSInterruptException:
        return  # The user has pressed Ctrl-C.
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        sys.exit(complain(str(error), 1))


def read_arguments(arguments: Sequence[str]) -> tuple[str, list[int]] | None:
    """Return the session and the amounts; return None if they are not a name and whole numbers."""
    try:
        session, amounts = arguments[0], [int(argument) for argument in arguments[1:]]
    except (IndexError, ValueError):
        return None
    fits = all(abs(amount) < 2**31 for amount in amounts)
    return (session, amounts) if session and amounts and fits else None


def _add_up(session: str, amounts: list[int]) -> None:
    # This call raises an error if no master runs; init_node would wait for ever.
    MasterClient(master_uri()).pid()
    rospy.init_node("session_client", anonymous=True)
    prepare_node()
    again = rospy.has_param("~rate")
    rate = rospy.Rate(number_parameter("~rate", 1.0, 0.1, 100.0))
    rospy.wait_for_service("add_up", timeout=TIMEOUT)
    proxy = BoundedProxy("add_up", AddUp, persistent=True, headers={FIELD: session}, timeout=TIMEOUT)
    while not rospy.is_shutdown():
        for amount in amounts:
            answer = proxy(amount)
            print(f"{session}: {answer.total} after {answer.calls} calls", flush=True)  # noqa: T201 -- its answer
            if again:
                rate.sleep()
        if not again:
            return
