"""The node `counter_camera`: a small grey camera above the counter of the robot cashier.

It publishes on `frames` (sensor_msgs/Image, mono8) what it sees, `~rate` (default 10) times a second, and
serves `let_in` (course_pkg/LetIn). With `~every` above 0, customers come by themselves, one in so many
seconds on average.
"""

from __future__ import annotations

import math
import random
import threading
import time
from typing import Any

import rospy
from sensor_msgs.msg import Image

from course_pkg.errors import FieldError
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import number_parameter, step_onto_graph
from course_pkg.shop.counter import Counter
from course_pkg.shop.frames import HEIGHT, WIDTH, frame_points
from course_pkg.srv import LetIn, LetInResponse

RATE = 10.0  # Hz
STAY = 4.0  # s that those who come by themselves stay


class CounterCamera:
    """The counter, and what the camera says of it."""

    def __init__(self, every: float) -> None:
        self._counter = Counter()
        self._every = every
        self._turn = threading.Lock()
        self._publisher = rospy.Publisher("frames", Image, queue_size=1, tcp_nodelay=True)

    def handle_let_in(self, request: Any) -> LetInResponse:  # noqa: ANN401 -- a class that catkin generates
        """Let customers in, and say when each comes."""
        try:
            with self._turn:
                visits = self._counter.let_in(time.time(), request.after, request.stay)
        except FieldError as error:
            raise rospy.ServiceException(str(error)) from error
        comes = [rospy.Time.from_sec(visit.comes) for visit in visits]
        return LetInResponse(first=visits[0].number if visits else 0, comes=comes)  # type: ignore[no-untyped-call]

    def watch(self, rate: float) -> None:
        """Publish what is seen until the node is shut down."""
        pace = rospy.Rate(rate)
        while not rospy.is_shutdown():
            self._publisher.publish(taken(self._there()))
            try:
                pace.sleep()
            except rospy.ROSInterruptException:  # shut down while it slept
                return

    def _there(self) -> int:
        """Return how many are at the counter; where nobody is to come, have somebody come by themselves."""
        with self._turn:
            now = time.time()
            if self._every and self._counter.next_change(now) == math.inf:
                self._counter.let_in(now, [random.expovariate(1 / self._every)], STAY)
            return len(self._counter.there(now))


def taken(customers: int) -> Image:
    """Return a frame with so many customers, taken now."""
    frame = Image(height=HEIGHT, width=WIDTH, encoding="mono8", step=WIDTH)  # type: ignore[no-untyped-call]
    frame.header.stamp = rospy.Time.now()
    frame.header.frame_id = "counter"
    frame.data = frame_points(customers)
    return frame


def main() -> None:
    """Watch the counter until the node is shut down."""
    if not step_onto_graph("counter_camera"):
        return
    rate = number_parameter("~rate", RATE, 0.1, 1000.0)
    every = number_parameter("~every", 0.0, 0.0, 600.0)
    with undisturbed():
        camera = CounterCamera(every)
        rospy.Service("let_in", LetIn, camera.handle_let_in)
    rospy.loginfo("Watching the counter")
    camera.watch(rate)
