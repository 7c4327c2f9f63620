"""The node `till`: adds the prices of a customer's items.

The service `till/set` (course_pkg/TillSet) sets the price of an item, `till/total` (course_pkg/TillTotal)
returns the sum, and `till/reset` (std_srvs/Trigger) removes all items. A price is added only after its line
has been printed with the service `print_line` (course_pkg/PrintLine).
"""

from __future__ import annotations

import threading

import rospy
from std_srvs.srv import Trigger, TriggerRequest

from course_pkg.errors import CourseError
from course_pkg.ros.node.program import serve_until_shutdown
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.srv import PrintLine, TillSet, TillSetRequest, TillTotal, TillTotalRequest

PRINTING = 5.0  # PRINTING is the time limit in s for a response of the printer.


class Till:
    """A till; several clients can call it at the same time. The till prints one line at a time."""

    def __init__(self) -> None:
        # A thread holds this lock while it prints a line and stores the price.
        self._turn = threading.Lock()
        self._cents: dict[str, int] = {}  # The dict contains the price of each item in cents.

    def handle_set(self, request: TillSetRequest) -> int:
        """Print and store the price of an item, and return the total in cents.

        Raise ServiceException and change nothing if the item has no name, if the price is negative, or if the
        printer is missing or refuses the line.
        """
        if not request.item:
            raise rospy.ServiceException("an item needs a name")
        if request.cents < 0:
            raise rospy.ServiceException(
                f"{request.item}: {request.cents} is negative, but cents have to be 0 or more"
            )
        with self._turn:
            try:
                BoundedProxy("print_line", PrintLine, timeout=PRINTING)(f"{request.item} {request.cents}")
            except CourseError as error:
                raise rospy.ServiceException(f"the printer does not respond: {error}") from error
            self._cents[request.item] = request.cents
            return sum(self._cents.values())

    def handle_total(self, _: TillTotalRequest) -> tuple[int, int]:
        """Return the sum of the prices in cents, and the number of items."""
        with self._turn:
            return sum(self._cents.values()), len(self._cents)

    def handle_reset(self, _: TriggerRequest) -> tuple[bool, str]:
        """Remove all items; the message contains the sum of their prices in cents.

        If the till is already empty, the call also succeeds.
        """
        with self._turn:
            if not self._cents:
                return True, "already empty"
            paid = sum(self._cents.values())
            self._cents = {}
        return True, f"paid {paid} cents"


def main() -> None:
    """Serve until the node is shut down."""
    till = Till()
    serve_until_shutdown(
        "till",
        {
            "till/set": (TillSet, till.handle_set),
            "till/total": (TillTotal, till.handle_total),
            "till/reset": (Trigger, till.handle_reset),
        },
    )
