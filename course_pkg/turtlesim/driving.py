"""Driving a turtle: a driver says how to go, and a drive asks it again and again and publishes the answer."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any, Protocol

from geometry_msgs.msg import Twist
from std_srvs.srv import EmptyResponse

from course_pkg.errors import NotAdvertised
from course_pkg.graph import Node

SPEED = 1.0  # m/s
TURN = 1.0  # rad/s
SLICE = 0.02  # s between looks at whether it is time, so that a new rate counts at once

Publish = Callable[[Any], object]


class Driver(Protocol):
    """Whoever decides how a turtle goes; `rate` is how often it is asked in a second."""

    rate: float

    def velocity(self) -> tuple[float, float]:
        """Return how fast to go (m/s) and to turn (rad/s)."""


class Toggling:
    """Goes straight or turns: the driver of pubvel_toggle, to be extended."""

    def __init__(self, rate: float = 2.0) -> None:
        self.rate = rate
        self.forward = True

    def velocity(self) -> tuple[float, float]:
        """Return how to go at this moment."""
        return (SPEED, 0.0) if self.forward else (0.0, TURN)

    def handle_toggle(self, _request: Any) -> EmptyResponse:  # noqa: ANN401 -- a class that catkin generates
        """Go straight if it turned, and turn if it went straight: the handler of toggle_forward."""
        self.forward = not self.forward
        return EmptyResponse()


def order(velocity: tuple[float, float]) -> Any:  # noqa: ANN401 -- a class that catkin generates
    """Return a velocity as the message that turtles obey."""
    message = Twist()
    message.linear.x, message.angular.z = map(float, velocity)
    return message


def keep_driving(driver: Driver, publish: Publish, over: Callable[[], bool]) -> None:
    """Publish the driver's velocity `driver.rate` times a second until `over()`; a new rate counts now."""
    last = -float("inf")
    while not over():
        now, period = time.monotonic(), 1.0 / driver.rate
        if now - last >= period:
            publish(order(driver.velocity()))
            last = max(last + period, now - SLICE)  # evenly, without catching up on what was missed
        time.sleep(min(max(last + period - time.monotonic(), 0.0), SLICE))


class Drive:
    """A drive in a notebook: on a thread of its own, until the same topic is driven anew or stop().

    A driver that raises an error, or answers with no pair of numbers, is asked no more; see `error`.
    """

    def __init__(self, node: Node, driver: Driver, topic: str = "/turtle1/cmd_vel") -> None:
        self.error = ""
        self._spoken = node.advertise(topic, Twist)
        self._over = threading.Event()
        self._driver = driver
        threading.Thread(target=self._drive, daemon=True, name=f"drive {topic}").start()

    def stop(self) -> None:
        """Say no more; the turtle stops a second after the last velocity."""
        self._over.set()
        self._spoken.stop()

    def __repr__(self) -> str:
        state = f"failed: {self.error}" if self.error else "stopped" if self._over.is_set() else "driving"
        return f"<{self._spoken.name}, {state}>"

    def _drive(self) -> None:
        try:
            keep_driving(self._driver, self._spoken.publish, self._over.is_set)
        except NotAdvertised:  # replaced, or the node has ended
            self._over.set()
        except Exception as error:  # noqa: BLE001 -- a student's driver may raise anything; it is shown, not printed
            self.error = f"{type(error).__name__}: {error}"


def drive(node: Node, driver: Driver, topic: str = "/turtle1/cmd_vel") -> Drive:
    """Drive a turtle from a notebook, in the place of an earlier drive of the same topic."""
    return Drive(node, driver, topic)
