"""The node that drives turtle1, with services that change the speed, the rate and the direction."""

from __future__ import annotations

import math

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty, SetBool, SetBoolRequest, SetBoolResponse

from course_pkg.ros import prepare_node
from course_pkg.srv import (
    ChangeRate,
    ChangeRateRequest,
    ChangeRateResponse,
    ChangeSpeed,
    ChangeSpeedRequest,
    ChangeSpeedResponse,
)
from course_pkg.turtlesim.driving import SPEED, Toggling, keep_driving

MAX_RATE = 100.0  # A driver publishes at most this number of velocity messages per second.


class AdjustableDriver(Toggling):
    """A driver that can stop and change its speed."""

    def __init__(self, rate: float) -> None:
        super().__init__(rate)
        self.speed = SPEED
        self.moving = True

    def velocity(self) -> tuple[float, float]:
        """Return the current velocity in m/s, and the angular velocity in rad/s."""
        forward, turn = super().velocity()
        return (forward and self.speed, turn) if self.moving else (0.0, 0.0)


class DriverServices:
    """The handlers of the services that change a driver."""

    def __init__(self, driver: AdjustableDriver) -> None:
        self.driver = driver

    def change_rate(self, request: ChangeRateRequest) -> ChangeRateResponse:
        """Change the number of velocity messages per second, and return the old number."""
        if not 0 < request.rate <= MAX_RATE:
            raise rospy.ServiceException(f"rate is {request.rate:g}, but must be above 0 and at most 100")
        before, self.driver.rate = self.driver.rate, request.rate
        return ChangeRateResponse(before)

    def change_speed(self, request: ChangeSpeedRequest) -> ChangeSpeedResponse:
        """Change the speed in m/s, and return the old speed."""
        if not math.isfinite(request.speed):
            raise rospy.ServiceException(f"speed is {request.speed:g}, but must be a finite number")
        before, self.driver.speed = self.driver.speed, request.speed
        return ChangeSpeedResponse(before)

    def start_stop(self, request: SetBoolRequest) -> SetBoolResponse:
        """Start the turtle if the request's `data` is true, else stop it."""
        word = "moving" if request.data else "standing"
        already = self.driver.moving == request.data
        self.driver.moving = request.data
        return SetBoolResponse(True, f"already {word}" if already else word)


def serve(services: DriverServices, *names: str) -> None:
    """Offer the services `names`; their handlers change the driver."""
    available = {
        "toggle_forward": (Empty, services.driver.handle_toggle),
        "change_rate": (ChangeRate, services.change_rate),
        "change_speed": (ChangeSpeed, services.change_speed),
        "start_stop": (SetBool, services.start_stop),
    }
    for name in names:
        kind, handler = available[name]
        rospy.Service(name, kind, handler)


def run(node: str, *services: str) -> None:
    """Run the node `node`, which drives turtle1 and offers the services, until the node is shut down."""
    rospy.init_node(node)
    prepare_node()
    driver = AdjustableDriver(_rate())
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1)
    serve(DriverServices(driver), *services)
    rospy.loginfo("Driving turtle1 by %s", ", ".join(services))
    keep_driving(driver, publisher.publish, rospy.is_shutdown)


def _rate() -> float:
    """Return the parameter ~rate, or 2 if the parameter is not a valid rate."""
    rate = rospy.get_param("~rate", 2.0)
    if isinstance(rate, (int, float)) and 0 < rate <= MAX_RATE:
        return float(rate)
    rospy.logwarn("~rate is %r, but must be above 0 and at most 100. The rate is now 2.", rate)
    return 2.0
