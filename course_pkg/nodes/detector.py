"""The node `detector`: tells from what a camera says on `counter` when a customer comes.

It publishes each customer once on `customers` (std_msgs/UInt32), and serves `detect_customer`
(course_pkg/DetectCustomer), which waits for one, but never longer than it is told to.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import rospy
from std_msgs.msg import UInt32, UInt32MultiArray

from course_pkg.errors import CameraSilent, FieldError
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import step_onto_graph, wait_until
from course_pkg.shop.watch import Customer, Watch
from course_pkg.srv import DetectCustomer, DetectCustomerResponse

LONGEST = 60.0  # s that a caller may wait
SILENCE = 2.0  # s after which a camera that says nothing counts as gone
CALLERS = 64  # who may wait at a time: each one takes a thread


class Detector:
    """Knows who is at the counter, says who comes, and answers who asks."""

    def __init__(self) -> None:
        self._watch = Watch(rospy.Time.now)
        self._places = threading.BoundedSemaphore(CALLERS)
        self._publisher = rospy.Publisher("customers", UInt32, queue_size=100)
        rospy.Subscriber("counter", UInt32MultiArray, self.handle_counter, tcp_nodelay=True)

    def knows(self) -> bool:
        """Whether the camera has said anything yet."""
        return self._watch.silent_for <= SILENCE

    def handle_counter(self, message: Any) -> None:  # noqa: ANN401 -- a class that genpy generates
        """Take in what the camera says, and publish who has come."""
        for customer in self._watch.see(message.data):
            self._publisher.publish(customer.number)

    def handle_detect(self, request: Any) -> DetectCustomerResponse:  # noqa: ANN401
        """Answer as soon as there is a customer above `after`, and after `patience` s in any case."""
        if not 0.0 <= request.patience <= LONGEST:  # which a NaN is not
            words = f"{request.patience:g} s cannot be waited"
            wrong = FieldError("patience", request.patience, f"seconds, from 0 to {LONGEST:g}", words)
            raise rospy.ServiceException(str(wrong))
        with self._place():
            customer = self._wait(request.after, request.patience)
        if customer is None:
            return DetectCustomerResponse(detected=False)  # type: ignore[no-untyped-call]
        return DetectCustomerResponse(True, customer.number, customer.arrived)  # type: ignore[no-untyped-call]

    def _wait(self, after: int, patience: float) -> Customer | None:
        """Wait for a customer; no customer and no camera are not the same, and only one is an answer."""
        try:
            return self._watch.wait(after, patience, SILENCE)
        except CameraSilent:
            words = (
                f"the camera has said nothing for {SILENCE:g} s, so nobody can tell: does shop_camera run?"
            )
            raise rospy.ServiceException(words) from None

    @contextmanager
    def _place(self) -> Iterator[None]:
        """Take one of the places for those who wait, or refuse."""
        if not self._places.acquire(blocking=False):
            raise rospy.ServiceException(f"{CALLERS} callers wait already: ask again later")
        try:
            yield
        finally:
            self._places.release()


def main() -> None:
    """Detect until the node is shut down."""
    if not step_onto_graph("detector"):
        return
    with undisturbed():
        detector = Detector()
    wait_until(detector.knows, SILENCE)  # or who asks first is told that the camera is silent
    with undisturbed():
        rospy.Service("detect_customer", DetectCustomer, detector.handle_detect)
    rospy.loginfo("Looking out for customers")
    rospy.spin()
