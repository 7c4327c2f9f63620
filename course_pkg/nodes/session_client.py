"""The node `session_client`: adds up in a session of its own by `add_up`, over one persistent connection."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import rospy

from course_pkg.errors import CourseError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.master import master_uri
from course_pkg.graph.preparation import prepare_node
from course_pkg.graph.program import PATIENCE, complain
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.stepping import number_parameter
from course_pkg.nodes.session_server import FIELD
from course_pkg.srv import AddUp

USAGE = (
    "usage: session_client SESSION AMOUNT…   (such as: session_client alice 5 10)\n"
    "With _rate:=2 it goes through the amounts again and again, twice a second, until Ctrl-C."
)


def main() -> None:
    """Print the total after each amount; exit with 1 when nobody answers, with 2 for a wrong line."""
    words = read_words(rospy.myargv(sys.argv)[1:])
    if words is None:
        sys.exit(complain(USAGE, 2))
    try:
        _ask(*words)
    except rospy.ROSInterruptException:
        return  # Ctrl-C
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        sys.exit(complain(str(error), 1))


def read_words(words: Sequence[str]) -> tuple[str, list[int]] | None:
    """Return the session and its amounts, or None when they are not a name and whole numbers."""
    try:
        session, amounts = words[0], [int(word) for word in words[1:]]
    except (IndexError, ValueError):
        return None
    fits = all(abs(amount) < 2**31 for amount in amounts)
    return (session, amounts) if session and amounts and fits else None


def _ask(session: str, amounts: list[int]) -> None:
    MasterClient(master_uri()).pid()  # init_node would wait for a master for ever
    rospy.init_node("session_client", anonymous=True)
    prepare_node()
    again = rospy.has_param("~rate")
    rate = rospy.Rate(number_parameter("~rate", 1.0, 0.1, 100.0))
    rospy.wait_for_service("add_up", timeout=PATIENCE)
    proxy = BoundedProxy("add_up", AddUp, persistent=True, headers={FIELD: session}, timeout=PATIENCE)
    while not rospy.is_shutdown():
        for amount in amounts:
            answer = proxy(amount)
            print(f"{session}: {answer.total} after {answer.calls} calls", flush=True)  # noqa: T201 -- its answer
            if again:
                rate.sleep()
        if not again:
            return
