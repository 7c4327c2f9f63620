"""The node `till`: adds up what a customer has to pay.

Its services are `~set` (course_pkg/TillSet), what an item costs, `~total` (course_pkg/TillTotal), and
`~reset` (std_srvs/Trigger), for the next customer. Nothing counts that the printer could not print.
"""

from __future__ import annotations

from typing import Any

import rospy
from std_srvs.srv import Trigger

from course_pkg.errors import PrinterFailed
from course_pkg.graph.program import serve_until_shutdown
from course_pkg.shop.till import OpenTill, Printer
from course_pkg.srv import TillSet, TillTotal

Request = Any  # a class that catkin generates


class Till(OpenTill):
    """A till that several clients may ask at the same moment."""

    def handle_set(self, request: Request) -> int:
        """Take in what an item costs, and return the total; or refuse, and change nothing."""
        if not request.item:
            raise rospy.ServiceException("an item needs a name")
        if request.cents < 0:
            raise rospy.ServiceException(
                f"{request.item}: {request.cents} is negative, and cents are 0 or more"
            )
        try:
            return self.put(request.item, request.cents)
        except PrinterFailed as error:
            raise rospy.ServiceException(str(error)) from error

    def handle_total(self, _: Request) -> tuple[int, int]:
        """Return the sum in cents, and how many items there are."""
        with self.turn:
            return sum(self.amounts.values()), len(self.amounts)

    def handle_reset(self, _: Request) -> tuple[bool, str]:
        """Forget the items, and say what their sum was; twice does no harm."""
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            paid = sum(self.amounts.values())
            self.amounts = {}
        return True, f"paid {paid} cents"


def main() -> None:
    """Serve until the node is shut down."""
    till = Till(Printer())
    services = {
        "~set": (TillSet, till.handle_set),
        "~total": (TillTotal, till.handle_total),
        "~reset": (Trigger, till.handle_reset),
    }
    serve_until_shutdown("till", services)
