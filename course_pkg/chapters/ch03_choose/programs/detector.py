"""The node `detector`: finds new customers in the messages on the topic `counter`, which a camera publishes.

The node publishes the number of each customer once on the topic `customers` (std_msgs/UInt32). The node also
offers the service `detect_customer` (course_pkg/DetectCustomer). A call waits for a customer; the request
contains the maximum waiting time.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

import rospy
from std_msgs.msg import UInt32, UInt32MultiArray

from course_pkg.errors import CameraSilent, FieldError
from course_pkg.ros.node.program import start_node, undisturbed, wait_until
from course_pkg.shop.watch import Customer, Watch
from course_pkg.srv import DetectCustomer, DetectCustomerRequest, DetectCustomerResponse

LONGEST = 60.0  # A caller can wait up to this time in s.
SILENCE = 2.0  # After this time in s without a message, the camera counts as stopped.
CALLERS = 64  # At most this many callers can wait at the same time, because each caller needs a thread.


class Detector:
    """Receives the camera's messages, publishes new customers, and handles calls."""

    def __init__(self) -> None:
        self._watch = Watch(rospy.Time.now)
        self._places = threading.BoundedSemaphore(CALLERS)
        self._publisher = rospy.Publisher("customers", UInt32, queue_size=100)
        rospy.Subscriber("counter", UInt32MultiArray, self.handle_counter, tcp_nodelay=True)

    def has_data(self) -> bool:
        """Return whether the camera has published a message recently."""
        return self._watch.silent_for <= SILENCE

    def handle_counter(self, message: UInt32MultiArray) -> None:
        """Handle a message from the camera, and publish each new customer."""
        for customer in self._watch.see(message.data):
            self._publisher.publish(customer.number)

    def handle_detect(self, request: DetectCustomerRequest) -> DetectCustomerResponse:
        """Return the first customer whose number is higher than the request's field `after`.

        The handler waits at most `patience` s for a customer with such a number. If none comes, the field
        `detected` of the response is False.

        Raises ServiceException if `patience` is out of range, if too many callers are waiting, or if the
        camera sends no messages.
        """
        # This test refuses NaN, because each comparison with NaN is False.
        if not 0.0 <= request.patience <= LONGEST:
            message = f"a wait of {request.patience:g} s is not possible"
            wrong = FieldError(
                "patience", request.patience, f"a number of seconds from 0 to {LONGEST:g}", message
            )
            raise rospy.ServiceException(str(wrong))
        with self._place():
            customer = self._wait(request.after, request.patience)
        if customer is None:
            return DetectCustomerResponse(detected=False)
        return DetectCustomerResponse(True, customer.number, customer.arrived)

    def _wait(self, after: int, patience: float) -> Customer | None:
        """Wait for a customer; return None if no customer comes.

        Raises ServiceException if the camera sends no messages.
        """
        try:
            return self._watch.wait(after, patience, SILENCE)
        except CameraSilent:
            silence = f"no message from the camera for {SILENCE:g} s"
            message = f"{silence}, so customers cannot be detected: check that shop_camera is running"
            raise rospy.ServiceException(message) from None

    @contextmanager
    def _place(self) -> Iterator[None]:
        """During the `with` block, count one more waiting caller.

        Raises ServiceException if too many callers are waiting.
        """
        if not self._places.acquire(blocking=False):
            raise rospy.ServiceException(f"{CALLERS} other clients are waiting, so call again later")
        try:
            yield
        finally:
            self._places.release()


def main() -> None:
    """Detect customers until the node is shut down."""
    if not start_node("detector"):
        return
    with undisturbed():
        detector = Detector()
    # Wait for the camera's first message; without this message, the first call would fail.
    wait_until(detector.has_data, SILENCE)
    with undisturbed():
        rospy.Service("detect_customer", DetectCustomer, detector.handle_detect)
        rospy.loginfo("The detector is ready")
    rospy.spin()
