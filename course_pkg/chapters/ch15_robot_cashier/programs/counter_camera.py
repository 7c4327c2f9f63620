"""The node `counter_camera`: a small grey camera above the counter of the robot cashier.

The node publishes images on the topic `frames` (sensor_msgs/Image, mono8), and offers the service `let_in`
(course_pkg/LetIn). The parameter `~rate` (default 10) is the number of images per second. If `~every` is
above 0, additional customers come at random times; `~every` is the average time in s between two of them.
"""

from __future__ import annotations

import math
import random
import threading
import time

import rospy
from sensor_msgs.msg import Image

from course_pkg.errors import FieldError
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed
from course_pkg.shop.counter import Counter
from course_pkg.shop.pictures import HEIGHT, WIDTH, frame_points
from course_pkg.srv import LetIn, LetInRequest, LetInResponse

RATE = 10.0  # The rate is in Hz.
STAY = 4.0  # An additional customer stays for `STAY` s.


class CounterCamera:
    """The counter with its customers, and the camera that publishes images of this counter."""

    def __init__(self, every: float) -> None:
        self._counter = Counter()
        self._every = every
        self._lock = threading.Lock()
        self._publisher = rospy.Publisher("frames", Image, queue_size=1, tcp_nodelay=True)

    def handle_let_in(self, request: LetInRequest) -> LetInResponse:
        """Let customers in, and return the times at which they come.

        Raises ServiceException for invalid values.
        """
        try:
            with self._lock:
                visits = self._counter.let_in(time.time(), request.after, request.stay)
        except FieldError as error:
            raise rospy.ServiceException(str(error)) from error
        comes = [rospy.Time.from_sec(visit.comes) for visit in visits]
        return LetInResponse(first=visits[0].number if visits else 0, comes=comes)

    def watch(self, rate: float) -> None:
        """Publish `rate` images per second until the node is shut down."""
        clock = rospy.Rate(rate)
        while not rospy.is_shutdown():
            self._publisher.publish(frame_of(self._there()))
            try:
                clock.sleep()
            except rospy.ROSInterruptException:  # The node was shut down during the pause.
                return

    def _there(self) -> int:
        """Return the number of customers at the counter; if no customer is planned, plan the next one."""
        with self._lock:
            now = time.time()
            if self._every and self._counter.next_change(now) == math.inf:
                self._counter.let_in(now, [random.expovariate(1 / self._every)], STAY)
            return len(self._counter.there(now))


def frame_of(customers: int) -> Image:
    """Return an image with this number of customers; the image's stamp is the current time."""
    frame = Image(height=HEIGHT, width=WIDTH, encoding="mono8", step=WIDTH)
    frame.header.stamp = rospy.Time.now()
    frame.header.frame_id = "counter"
    frame.data = frame_points(customers)
    return frame


def main() -> None:
    """Publish images of the counter until the node is shut down."""
    if not start_node("counter_camera"):
        return
    rate = number_parameter("~rate", RATE, 0.1, 1000.0)
    every = number_parameter("~every", 0.0, 0.0, 600.0)
    with undisturbed():
        camera = CounterCamera(every)
        rospy.Service("let_in", LetIn, camera.handle_let_in)
        rospy.loginfo("Watching the counter")
    camera.watch(rate)
