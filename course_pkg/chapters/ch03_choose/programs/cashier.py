"""The node `cashier` greets every customer once, with one of three designs.

The parameter `~design` is `poll`, `topic` or `wait`. With `poll`, the node calls the service
`detect_customer` at the rate `~rate` (in Hz), and also immediately after each new customer. With `topic`, the
node subscribes to the topic `customers`. With `wait`, the node also calls the service `detect_customer`, but
the server waits for a customer before it responds; `~patience` is the maximum waiting time in s. The node
publishes the number of each greeted customer on the topic `greetings` (std_msgs/UInt32), and offers the
service `~report` (course_pkg/CashierReport).
"""

from __future__ import annotations

import sys
import threading
import time
from collections import deque

import rospy
from std_msgs.msg import UInt32

from course_pkg.errors import CourseError
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed, wait_until
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.srv import CashierReport, CashierReportResponse, DetectCustomer

DESIGNS = ("poll", "topic", "wait")
KEPT = 10_000  # The report contains data about at most this many greetings.
GRACE = 2.0  # GRACE is the additional time in s that a call may take after `~patience` s.
AGAIN = 0.5  # AGAIN is the time in s between a failed call and the next call.
CONNECTED = 5.0  # The cashier waits up to this time in s for a publisher, and then serves the report.


class Cashier:
    """Greets customers; for each greeting, stores the customer's number and the time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._asked = self._received = self._last = 0
        self._greeted: deque[tuple[int, rospy.Time]] = deque(maxlen=KEPT)
        self._informed: deque[rospy.Time] = deque(maxlen=KEPT)
        self._publisher = rospy.Publisher("greetings", UInt32, queue_size=100)
        self._detect = BoundedProxy("detect_customer", DetectCustomer)
        # A shutdown cancels the current call; otherwise, the shutdown would wait for the end of the call.
        rospy.on_shutdown(self._detect.cancel)

    def handle_report(self, _: object) -> CashierReportResponse:
        """Return a report with the customers' numbers and the times of all greetings."""
        with self._lock:
            numbers, times = zip(*self._greeted, strict=True) if self._greeted else ((), ())
            return CashierReportResponse(
                self._asked, self._received, list(numbers), list(times), list(self._informed)
            )

    def receive(self, message: UInt32) -> None:
        """Handle a message with the number of a customer."""
        with self._lock:
            self._received += 1
        self._greet_new(message.data)

    def run_subscriber(self) -> None:
        """Greet the customers on the topic until the node is shut down."""
        with undisturbed():
            subscriber = rospy.Subscriber("customers", UInt32, self.receive, tcp_nodelay=True)
        wait_until(subscriber.get_num_connections, CONNECTED)
        self.offer_report()
        rospy.spin()

    def run_client(self, patience: float, pause: float) -> None:
        """Call the detector and greet new customers until the node is shut down.

        Every `pause` s, the node begins a series of calls. The series ends when there is no new customer.
        """
        self.offer_report()
        due = time.monotonic()
        while not rospy.is_shutdown():
            try:
                while self._ask(patience):  # There may be several new customers at the same time.
                    pass
                rest = pause
            except (rospy.ServiceException, CourseError) as error:
                if rospy.is_shutdown():  # The shutdown has cancelled the call.
                    return
                with undisturbed():  # For each log message, rospy calls the master.
                    rospy.logwarn_throttle(10, f"The call failed, so the cashier soon calls again: {error}")
                rest = max(pause, AGAIN)
            due = max(due + rest, time.monotonic())
            rospy.sleep(due - time.monotonic())

    def offer_report(self) -> None:
        """Serve ~report; when this service exists, the cashier is ready."""
        with undisturbed():
            rospy.Service("~report", CashierReport, self.handle_report)

    def _ask(self, patience: float) -> bool:
        """Request the next customer; return whether there is a new customer.

        Raises the same errors as a service call.
        """
        with self._lock:
            self._asked += 1
        answer = self._detect.call(after=self._last, patience=patience, timeout=patience + GRACE)
        return self._greet_new(answer.number if answer.detected else 0)

    def _greet_new(self, number: int) -> bool:
        """Greet the customer `number` and store the time; return False if the customer is not new."""
        with self._lock:
            now = rospy.Time.now()
            self._informed.append(now)
            if number <= self._last:
                return False
            self._last = number
            self._greeted.append((number, now))
        self._publisher.publish(number)
        return True


def main() -> None:
    """Greet customers until the node is shut down."""
    if not start_node("cashier"):
        return
    with undisturbed():
        design = rospy.get_param("~design", "wait")
    if design not in DESIGNS:
        sys.exit(f"~design is {design!r}, but it has to be one of {', '.join(DESIGNS)}.")
    rate = number_parameter("~rate", 2.0, 0.01, 1000.0)
    patience = number_parameter("~patience", 2.0, 0.1, 60.0)
    with undisturbed():
        cashier = Cashier()
    try:
        if design == "topic":
            cashier.run_subscriber()
        elif design == "poll":
            cashier.run_client(patience=0.0, pause=1 / rate)
        else:
            # While it handles a call, the server waits up to `patience` s for a customer, so no additional
            # pause is needed.
            cashier.run_client(patience=patience, pause=patience)
    except rospy.ROSInterruptException:  # The node was shut down during a sleep.
        return
