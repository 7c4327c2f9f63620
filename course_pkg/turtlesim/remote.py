"""The services by which a toggling driver is steered from outside."""

from __future__ import annotations

import math
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty, SetBool, SetBoolResponse

from course_pkg.graph import prepare_node
from course_pkg.srv import ChangeRate, ChangeRateResponse, ChangeSpeed, ChangeSpeedResponse
from course_pkg.turtlesim.driving import SPEED, Toggling, keep_driving

FASTEST = 100.0  # messages a second


class Steered(Toggling):
    """A driver whose speed can be set, and that can be stopped."""

    def __init__(self, rate: float) -> None:
        super().__init__(rate)
        self.speed = SPEED
        self.moving = True

    def velocity(self) -> tuple[float, float]:
        """Return how to go at this moment."""
        forward, turn = super().velocity()
        return (forward and self.speed, turn) if self.moving else (0.0, 0.0)


class Remote:
    """Handlers that change a driver; each returns what its service answers."""

    def __init__(self, driver: Steered) -> None:
        self.driver = driver

    def change_rate(self, request: Any) -> ChangeRateResponse:  # noqa: ANN401
        """Speak more or less often."""
        if not 0 < request.rate <= FASTEST:
            raise rospy.ServiceException(f"rate is {request.rate:g}, and has to be above 0 and at most 100")
        before, self.driver.rate = self.driver.rate, request.rate
        return ChangeRateResponse(before)  # type: ignore[no-untyped-call]

    def change_speed(self, request: Any) -> ChangeSpeedResponse:  # noqa: ANN401
        """Go faster or slower."""
        if not math.isfinite(request.speed):
            raise rospy.ServiceException(f"speed is {request.speed:g}, and has to be a finite number")
        before, self.driver.speed = self.driver.speed, request.speed
        return ChangeSpeedResponse(before)  # type: ignore[no-untyped-call]

    def start_stop(self, request: Any) -> SetBoolResponse:  # noqa: ANN401
        """Move, or stand."""
        word = "moving" if request.data else "standing"
        already = self.driver.moving == request.data
        self.driver.moving = request.data
        return SetBoolResponse(True, f"already {word}" if already else word)


def serve(remote: Remote, *names: str) -> None:
    """Serve those of the driver's services that are named."""
    offers = {
        "toggle_forward": (Empty, remote.driver.handle_toggle),
        "change_rate": (ChangeRate, remote.change_rate),
        "change_speed": (ChangeSpeed, remote.change_speed),
        "start_stop": (SetBool, remote.start_stop),
    }
    for name in names:
        kind, handler = offers[name]
        rospy.Service(name, kind, handler)


def run(node: str, *services: str) -> None:
    """Be the node that drives turtle1 and offers these services, until it is shut down."""
    rospy.init_node(node)
    prepare_node()
    driver = Steered(_rate())
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1)
    serve(Remote(driver), *services)
    rospy.loginfo("Driving turtle1 by %s", ", ".join(services))
    keep_driving(driver, publisher.publish, rospy.is_shutdown)


def _rate() -> float:
    """Return the parameter ~rate, or 2 where it is no rate."""
    rate = rospy.get_param("~rate", 2.0)
    if isinstance(rate, (int, float)) and 0 < rate <= FASTEST:
        return float(rate)
    rospy.logwarn("~rate is %r, and has to be above 0 and at most 100: taking 2", rate)
    return 2.0
