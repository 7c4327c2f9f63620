"""The node `polled_camera`: takes one picture of the shop when it is asked to.

It serves `request_image` (course_pkg/PolledImage). Who is in the picture it knows from `counter`, where
`shop_camera` publishes; while nobody does, it looks into a shop of its own, where customers come and go.
With `~stream` above 0 it also publishes as many pictures a second on `image` (sensor_msgs/Image).
"""

from __future__ import annotations

import math
import random
import time
from typing import Any

import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import UInt32MultiArray

from course_pkg.errors import FieldError
from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import number_parameter, step_onto_graph, wait_until
from course_pkg.shop.drawing import shop_picture
from course_pkg.shop.watch import Watch
from course_pkg.srv import PolledImage, PolledImageResponse

WIDTH, HEIGHT = 320, 240  # points, where the caller leaves it to the camera
LEAST, MOST = 16, 1280  # points
SILENCE = 1.0  # s after which `counter` counts as silent
MOOD = 4.0  # s for which the own shop stays as it is


class PolledCamera:
    """Takes pictures."""

    def __init__(self) -> None:
        self._watch = Watch()
        rospy.Subscriber("counter", UInt32MultiArray, self._watch.hear)

    def looks_at_the_shop(self) -> bool:
        """Whether shop_camera tells who is there."""
        return self._watch.silent_for < SILENCE

    def handle_request(self, request: Any) -> PolledImageResponse:  # noqa: ANN401 -- a class that catkin generates
        """Take a picture of the size asked for."""
        try:
            width = _side("width", request.width or WIDTH)
            height = _side("height", request.height or HEIGHT)
        except FieldError as error:
            raise rospy.ServiceException(str(error)) from error
        customers = self._customers()
        return PolledImageResponse(picture(width, height, customers), customers)  # type: ignore[no-untyped-call]

    def stream(self, rate: float) -> None:
        """Publish `rate` pictures a second until the node is shut down."""
        publisher = rospy.Publisher("image", Image, queue_size=2)
        clock = rospy.Rate(rate)
        while not rospy.is_shutdown():
            publisher.publish(picture(WIDTH, HEIGHT, self._customers()))
            clock.sleep()

    def _customers(self) -> int:
        if self.looks_at_the_shop():
            return self._watch.count
        return random.Random(math.floor(time.time() / MOOD)).randint(0, 4)  # noqa: S311 -- no secret


def picture(width: int, height: int, customers: int) -> Image:
    """Return a picture of the shop with so many customers, taken now."""
    image = Image(height=height, width=width, encoding="rgb8", step=3 * width)  # type: ignore[no-untyped-call]
    image.header.stamp = rospy.Time.now()
    image.header.frame_id = "camera"
    image.data = shop_picture(width, height, customers)
    return image


def _side(name: str, points: int) -> int:
    if not LEAST <= points <= MOST:
        raise FieldError(name, points, f"{LEAST} to {MOST} points, or 0 for what the camera likes best")
    return points


def main() -> None:
    """Take pictures until the node is shut down."""
    if not step_onto_graph("polled_camera"):
        return
    rate = number_parameter("~stream", 0.0, 0.0, 100.0)
    with undisturbed():
        camera = PolledCamera()
    wait_until(camera.looks_at_the_shop, SILENCE / 2)  # or the first picture is of the wrong shop
    with undisturbed():
        rospy.Service("request_image", PolledImage, camera.handle_request)
    rospy.loginfo("Ready to take pictures")
    try:
        camera.stream(rate) if rate else rospy.spin()
    except rospy.ROSInterruptException:  # shut down while it slept
        return
