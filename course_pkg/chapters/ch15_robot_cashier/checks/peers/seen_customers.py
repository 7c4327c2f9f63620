"""Replaces the node vision: publishes on customer_seen whether a customer is there."""

from __future__ import annotations

import threading
import time

import rospy
from std_msgs.msg import Bool

from course_pkg.checking import CheckContext
from course_pkg.waiting import wait_until

EVERY = 0.1  # EVERY is the time in s between two messages.


class SeenCustomers:
    """Publishes `customer` every 0.1 s unless it is None; `last` is the time of the last message."""

    def __init__(self, topic: str) -> None:
        self.customer: bool | None = None
        self.last = -float("inf")  # The time is in s of time.monotonic().
        self._publisher = rospy.Publisher(topic, Bool, queue_size=10, tcp_nodelay=True)
        self._lock = threading.Lock()
        threading.Thread(target=self._publish, daemon=True).start()

    def is_heard(self, context: CheckContext) -> None:
        """Assert that the student's node receives the messages."""
        context.require(
            "the node subscribes to customer_seen with the type std_msgs/Bool",
            holds=bool(wait_until(self._publisher.get_num_connections, 5.0)),
            expected="a subscriber of the type std_msgs/Bool",
            actual="a subscriber of another type",
            hints=(
                "The node does not subscribe to customer_seen with the right type. Pass std_msgs/Bool "
                "to rospy.Subscriber."
            ),
        )

    def show(self, customer: bool | None) -> None:
        """From now on, publish the value `customer`; return when the first such message has arrived."""
        with self._lock:
            self.customer = customer
            self._send()
        time.sleep(0.05)

    def show_later(self, after: float, customer: bool | None) -> None:
        """Wait for the time `after` (s), and then begin to publish `customer`; for None, publish nothing."""
        timer = threading.Timer(after, self.show, [customer])
        timer.daemon = True
        timer.start()

    def silent_for(self) -> float:
        """Return the time in s since the last message."""
        return time.monotonic() - self.last

    def _send(self) -> None:
        if self.customer is not None:
            self.last = time.monotonic()
            self._publisher.publish(self.customer)

    def _publish(self) -> None:
        while not rospy.is_shutdown():
            with self._lock:
                self._send()
            time.sleep(EVERY)
