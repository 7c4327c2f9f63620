"""A driver returns velocities for a turtle, and `keep_driving` publishes them at the driver's rate."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Protocol

from geometry_msgs.msg import Twist
from std_srvs.srv import EmptyRequest, EmptyResponse

SPEED = 1.0  # This is the default speed in m/s.
TURN = 1.0  # This is the default angular velocity in rad/s.
SLICE = 0.02  # keep_driving() waits at most this time in s, so a new rate takes effect within this time.

Publish = Callable[[Twist], None]


class Driver(Protocol):
    """An object that decides how a turtle moves. `rate` is the number of velocity messages per second."""

    rate: float

    def velocity(self) -> tuple[float, float]:
        """Return the current velocity in m/s, and the angular velocity in rad/s."""


class Toggling:
    """A base class for drivers that go straight or turn, as in pubvel_toggle."""

    def __init__(self, rate: float = 2.0) -> None:
        self.rate = rate
        self.forward = True

    def velocity(self) -> tuple[float, float]:
        """Return the current velocity in m/s, and the angular velocity in rad/s."""
        return (SPEED, 0.0) if self.forward else (0.0, TURN)

    def handle_toggle(self, _request: EmptyRequest) -> EmptyResponse:
        """Switch between driving straight and turning; this method is the handler of toggle_forward."""
        self.forward = not self.forward
        return EmptyResponse()


def to_twist(velocity: tuple[float, float]) -> Twist:
    """Return a velocity (m/s, rad/s) as a message for the topic cmd_vel of a turtle."""
    message = Twist()
    message.linear.x, message.angular.z = map(float, velocity)
    return message


def keep_driving(driver: Driver, publish: Publish, over: Callable[[], bool]) -> None:
    """Publish the driver's velocity at the rate `driver.rate` (1/s), until the function `over` returns True.

    The rate can change while this function runs.
    """
    last = -float("inf")
    while not over():
        now, period = time.monotonic(), 1.0 / driver.rate
        if now - last >= period:
            publish(to_twist(driver.velocity()))
            # If this thread was delayed, skip the velocities that it should have published during the delay.
            last = max(last + period, now - SLICE)
        time.sleep(min(max(last + period - time.monotonic(), 0.0), SLICE))
