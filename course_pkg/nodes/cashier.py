"""The node `cashier`: greets every customer once, in one of three designs.

`~design` is `poll` (ask `detect_customer` `~rate` times a second, and once more after each customer), `topic`
(listen to `customers`), or `wait` (ask `detect_customer`, and let the question stand for `~patience` s). It
publishes whom it greets on `greetings` (std_msgs/UInt32), and serves `~report` (course_pkg/CashierReport).
"""

from __future__ import annotations

import sys
import threading
import time
from collections import deque
from typing import Any

import rospy
from std_msgs.msg import UInt32

from course_pkg.errors import CourseError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import number_parameter, step_onto_graph, wait_until
from course_pkg.srv import CashierReport, CashierReportResponse, DetectCustomer

DESIGNS = ("poll", "topic", "wait")
KEPT = 10_000  # moments in the report
GRACE = 2.0  # s for an answer, beyond what the question itself may take
AGAIN = 0.5  # s until a question that failed is put again
CONNECTED = 5.0  # s to wait for a publisher before the report is offered all the same


class Cashier:
    """Greets, and takes note of it."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._asked = self._heard = self._last = 0
        self._greeted: deque[tuple[int, rospy.Time]] = deque(maxlen=KEPT)
        self._learnt: deque[rospy.Time] = deque(maxlen=KEPT)
        self._publisher = rospy.Publisher("greetings", UInt32, queue_size=100)
        self._detect = BoundedProxy("detect_customer", DetectCustomer)
        rospy.on_shutdown(self._detect.cancel)  # or the end waits for the answer to a question that stands

    def handle_report(self, _: object) -> CashierReportResponse:
        """Say what has been done so far."""
        with self._turn:
            numbers, times = zip(*self._greeted, strict=True) if self._greeted else ((), ())
            return CashierReportResponse(  # type: ignore[no-untyped-call]
                self._asked, self._heard, list(numbers), list(times), list(self._learnt)
            )

    def hear(self, message: Any) -> None:  # noqa: ANN401 -- a class that genpy generates
        """Take in the number of a customer who has come."""
        with self._turn:
            self._heard += 1
        self._learn(message.data)

    def listen(self) -> None:
        """Hear whoever comes, until the node is shut down."""
        with undisturbed():
            subscriber = rospy.Subscriber("customers", UInt32, self.hear, tcp_nodelay=True)
        wait_until(subscriber.get_num_connections, CONNECTED)
        self.offer_report()
        rospy.spin()

    def keep_asking(self, patience: float, pause: float) -> None:
        """Ask until nobody is left, and again every `pause` s, until the node is shut down."""
        self.offer_report()
        due = time.monotonic()
        while not rospy.is_shutdown():
            try:
                while self._ask(patience):  # there may be two
                    pass
                rest = pause
            except (rospy.ServiceException, CourseError) as error:
                if rospy.is_shutdown():  # which has cancelled the question
                    return
                rospy.logwarn_throttle(10, f"No answer, and asking on: {error}")
                rest = max(pause, AGAIN)
            due = max(due + rest, time.monotonic())
            rospy.sleep(due - time.monotonic())

    def offer_report(self) -> None:
        """Serve the report: from then on the cashier is at work."""
        with undisturbed():
            rospy.Service("~report", CashierReport, self.handle_report)

    def _ask(self, patience: float) -> bool:
        """Ask for the next customer; return whether there was a new one. Raises what a call raises."""
        with self._turn:
            self._asked += 1
        answer = self._detect.call(after=self._last, patience=patience, timeout=patience + GRACE)
        return self._learn(answer.number if answer.detected else 0)

    def _learn(self, number: int) -> bool:
        """Take note that there was news, and greet the customer `number`; False if they were before."""
        with self._turn:
            now = rospy.Time.now()
            self._learnt.append(now)
            if number <= self._last:
                return False
            self._last = number
            self._greeted.append((number, now))
        self._publisher.publish(number)
        return True


def main() -> None:
    """Greet until the node is shut down."""
    if not step_onto_graph("cashier"):
        return
    design = rospy.get_param("~design", "wait")
    if design not in DESIGNS:
        sys.exit(f"~design is {design!r}, and has to be one of {', '.join(DESIGNS)}.")
    rate = number_parameter("~rate", 2.0, 0.01, 1000.0)
    patience = number_parameter("~patience", 2.0, 0.1, 60.0)
    with undisturbed():
        cashier = Cashier()
    try:
        if design == "topic":
            cashier.listen()
        elif design == "poll":
            cashier.keep_asking(patience=0.0, pause=1 / rate)
        else:
            cashier.keep_asking(patience=patience, pause=patience)  # which is over when the answer is no
    except rospy.ROSInterruptException:  # shut down while it slept
        return
