"""The node `shop_camera`: a shop with a counter and a camera that observes the counter.

The node publishes the numbers of the customers at the counter on the topic `counter`
(std_msgs/UInt32MultiArray): ten times per second, and when a customer comes or leaves. The node also offers
the service `let_in` (course_pkg/LetIn). If `~every` is above 0, additional customers come at random times;
`~every` is the average time in s between two of them.
"""

from __future__ import annotations

import math
import random
import threading
import time
from collections.abc import Sequence
from contextlib import suppress

import rospy
from std_msgs.msg import UInt32MultiArray

from course_pkg.errors import FieldError
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed
from course_pkg.shop.counter import Counter, Visit
from course_pkg.srv import LetIn, LetInRequest, LetInResponse

PERIOD = 0.1  # While nothing changes, the camera publishes every `PERIOD` s.
STAY = 4.0  # A random customer stays for `STAY` s.


class ShopCamera:
    """The shop and its camera."""

    def __init__(self, number: int, every: float) -> None:
        self._counter = Counter(number)
        self._every = every
        self._changed = threading.Condition()
        self._publisher = rospy.Publisher("counter", UInt32MultiArray, queue_size=10)

    def handle_let_in(self, request: LetInRequest) -> LetInResponse:
        """Let customers in, and return the times at which they come.

        Raises ServiceException for invalid values.
        """
        try:
            visits = self._let_in(request.after, request.stay)
        except FieldError as error:
            raise rospy.ServiceException(str(error)) from error
        comes = [rospy.Time.from_sec(visit.comes) for visit in visits]
        return LetInResponse(first=visits[0].number if visits else 0, comes=comes)

    def watch(self) -> None:
        """Publish the numbers of the customers at the counter until the node is shut down."""
        while not rospy.is_shutdown():
            with self._changed:
                now = time.time()
                self._publisher.publish(data=self._counter.there(now))
                change = self._counter.next_change(now)
                self._changed.wait(max(min(change - time.time(), PERIOD), 0.0))
            if self._every and change == math.inf:
                self._let_in([random.expovariate(1 / self._every)], STAY)

    def _let_in(self, after: Sequence[float], stay: float) -> list[Visit]:
        with self._changed:
            visits = self._counter.let_in(time.time(), after, stay)
            self._changed.notify()
        # A client waits for a customer whose number is higher than the last number that it received.
        # Therefore, the numbers must continue after a restart of this node. If no master is running, the
        # parameter ~number cannot be stored; after a restart, the numbers then start at 1.
        with suppress(OSError, rospy.ROSException):
            rospy.set_param("~number", self._counter.number)
        return visits


def main() -> None:
    """Run the shop until the node is shut down."""
    if not start_node("shop_camera"):
        return
    number = number_parameter("~number", 1, 1, 2**31)
    every = number_parameter("~every", 0.0, 0.0, 600.0)
    with undisturbed():
        camera = ShopCamera(int(number), every)
        rospy.Service("let_in", LetIn, camera.handle_let_in)
        rospy.loginfo("The camera is running")
    camera.watch()
