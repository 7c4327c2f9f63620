"""The node `polled_camera`: returns one picture of the shop for each call.

The node offers the service `request_image` (PolledImage). The node subscribes to the topic `counter`, which
contains the customers that the node `shop_camera` sees. If no messages arrive, the pictures show a random
number of customers. If `~stream` is above 0, the node also publishes this number of pictures per second on
the topic `image` (sensor_msgs/Image).
"""

from __future__ import annotations

import math
import random
import time

import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import UInt32MultiArray

from course_pkg.errors import FieldError
from course_pkg.ros.node.program import number_parameter, start_node, undisturbed, wait_until
from course_pkg.shop.pictures import shop_picture
from course_pkg.shop.watch import Watch
from course_pkg.srv import PolledImage, PolledImageRequest, PolledImageResponse

WIDTH, HEIGHT = 320, 240  # If the request contains 0, this size in pixels is used.
LEAST, MOST = 16, 1280  # A width or height must be in this range of pixels.
# The last message on the topic `counter` is used for this time in s.
SILENCE = 1.0
UNCHANGED = 4.0  # The random number of customers does not change for this time in s.


class PolledCamera:
    """Handles requests for pictures of the shop, and publishes a stream of pictures."""

    def __init__(self) -> None:
        self._watch = Watch()
        rospy.Subscriber("counter", UInt32MultiArray, self._watch.hear)

    def knows_the_shop(self) -> bool:
        """Return whether a message of shop_camera has arrived in the last `SILENCE` seconds."""
        return self._watch.silent_for < SILENCE

    def handle_request(self, request: PolledImageRequest) -> PolledImageResponse:
        """Return a picture of the requested size; raise ServiceException for an impossible size."""
        try:
            width = _side("width", request.width or WIDTH)
            height = _side("height", request.height or HEIGHT)
        except FieldError as error:
            raise rospy.ServiceException(str(error)) from error
        customers = self._customers()
        return PolledImageResponse(picture(width, height, customers), customers)

    def stream(self, rate: float) -> None:
        """Publish pictures until the node is shut down; `rate` is the number of pictures per second."""
        publisher = rospy.Publisher("image", Image, queue_size=2)
        clock = rospy.Rate(rate)
        while not rospy.is_shutdown():
            publisher.publish(picture(WIDTH, HEIGHT, self._customers()))
            clock.sleep()

    def _customers(self) -> int:
        if self.knows_the_shop():
            return self._watch.count
        return random.Random(math.floor(time.time() / UNCHANGED)).randint(0, 4)  # noqa: S311 -- no secret


def picture(width: int, height: int, customers: int) -> Image:
    """Return a picture of the shop with this number of customers and the current time as its time stamp."""
    image = Image(height=height, width=width, encoding="rgb8", step=3 * width)
    image.header.stamp = rospy.Time.now()
    image.header.frame_id = "camera"
    image.data = shop_picture(width, height, customers)
    return image


def _side(name: str, points: int) -> int:
    if not LEAST <= points <= MOST:
        raise FieldError(name, points, f"{LEAST} to {MOST} points, or 0 for the camera's usual size")
    return points


def main() -> None:
    """Offer the service, and publish pictures, until the node is shut down."""
    if not start_node("polled_camera"):
        return
    rate = number_parameter("~stream", 0.0, 0.0, 100.0)
    with undisturbed():
        camera = PolledCamera()
    # Wait for the first message; the first picture then shows the real customers.
    wait_until(camera.knows_the_shop, SILENCE / 2)
    with undisturbed():
        rospy.Service("request_image", PolledImage, camera.handle_request)
        rospy.loginfo("Ready to take pictures")
    try:
        camera.stream(rate) if rate else rospy.spin()
    except rospy.ROSInterruptException:  # The node was shut down during a sleep.
        return
