"""Drives a turtle: a driver returns velocities, and `keep_driving` publishes them at the driver's rate."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Protocol

from geometry_msgs.msg import Twist
from std_srvs.srv import EmptyRequest, EmptyResponse

SPEED = 1.0  # m/s
TURN = 1.0  # rad/s
SLICE = 0.02  # time in s between two checks of the clock; a new rate takes effect within this time

Publish = Callable[[Twist], None]


class Driver(Protocol):
    """An object that decides how a turtle moves. `rate` is the number of velocity messages per second."""

    rate: float

    def velocity(self) -> tuple[float, float]:
        """Return the present velocity in m/s, and the angular velocity in rad/s."""


class Toggling:
    """A driver that goes straight or turns, as in pubvel_toggle. It is a base class for other drivers."""

    def __init__(self, rate: float = 2.0) -> None:
        self.rate = rate
        self.forward = True

    def velocity(self) -> tuple[float, float]:
        """Return the present velocity in m/s, and the angular velocity in rad/s."""
        return (SPEED, 0.0) if self.forward else (0.0, TURN)

    def handle_toggle(self, _request: EmptyRequest) -> EmptyResponse:
        """Change between going straight and turning. This is the handler of toggle_forward."""
        self.forward = not self.forward
        return EmptyResponse()


def to_twist(velocity: tuple[float, float]) -> Twist:
    """Return a velocity (m/s, rad/s) as a message for the topic cmd_vel of a turtle."""
    message = Twist()
    message.linear.x, message.angular.z = map(float, velocity)
    return message


def keep_driving(driver: Driver, publish: Publish, over: Callable[[], bool]) -> None:
    """Publish the driver's velocity `driver.rate` times per second, until `over()` is true.

    The rate may change during this time.
    """
    last = -float("inf")
    while not over():
        now, period = time.monotonic(), 1.0 / driver.rate
        if now - last >= period:
            publish(to_twist(driver.velocity()))
            # After a delay, the velocities that were not published in time are skipped.
            last = max(last + period, now - SLICE)
        time.sleep(min(max(last + period - time.monotonic(), 0.0), SLICE))
