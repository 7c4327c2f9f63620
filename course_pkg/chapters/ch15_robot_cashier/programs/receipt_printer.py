"""The node `receipt_printer`: prints one line at a time until it has no paper.

The node offers the service `print_line` (course_pkg/PrintLine), and publishes each printed line on the topic
`receipt` (std_msgs/String). The private parameter `~paper` (default 1000) is the number of lines that can be
printed.
"""

from __future__ import annotations

import rospy
from std_msgs.msg import String

from course_pkg.errors import PrinterFailed
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed
from course_pkg.shop.printer import Printer
from course_pkg.srv import PrintLine, PrintLineRequest, PrintLineResponse

PAPER = 1000  # The paper is long enough for this many lines.


class ReceiptPrinter:
    """Serves the printer."""

    def __init__(self, paper: int) -> None:
        self._printer = Printer(paper)
        self._receipt = rospy.Publisher("receipt", String, queue_size=100)

    def handle_print(self, request: PrintLineRequest) -> PrintLineResponse:
        """Print a line; raises ServiceException if nothing was printed."""
        try:
            self._printer.print(request.line)
        except PrinterFailed as error:
            raise rospy.ServiceException(str(error)) from error
        self._receipt.publish(request.line)
        return PrintLineResponse()


def main() -> None:
    """Print lines until the node is shut down."""
    if not start_node("receipt_printer"):
        return
    paper = int(number_parameter("~paper", PAPER, 0, 1e6))
    with undisturbed():
        printer = ReceiptPrinter(paper)
        rospy.Service("print_line", PrintLine, printer.handle_print)
    rospy.spin()
