"""A turtle's place on the graph: two topics that it speaks on, one that it obeys, three services."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Color, Pose
from turtlesim.srv import (
    SetPen,
    SetPenResponse,
    TeleportAbsolute,
    TeleportAbsoluteResponse,
    TeleportRelative,
    TeleportRelativeResponse,
)

from course_pkg.turtlesim.answering import Answering, Refused
from course_pkg.turtlesim.brisk import publish_briskly
from course_pkg.turtlesim.paper import Paper
from course_pkg.turtlesim.world import Pen, Turtle, Velocity, sound

InTick = Callable[[Callable[[], None]], None]


class Actor:
    """Publishes and obeys for one turtle, until it is closed.

    `in_tick` has a piece of work done between two ticks, and returns when it is done.
    """

    def __init__(self, turtle: Turtle, paper: Paper, in_tick: InTick) -> None:
        self.turtle = turtle
        self._paper = paper
        self._in_tick = in_tick
        self._closed = False
        name = turtle.name
        self._pose = rospy.Publisher(f"{name}/pose", Pose, queue_size=1)
        self._colour = rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1)
        for publisher in (self._pose, self._colour):
            publish_briskly(publisher)
        self._ordered = rospy.Subscriber(f"{name}/cmd_vel", Twist, self._obey, queue_size=1, tcp_nodelay=True)
        self._services: list[Any] = [
            Answering(f"{name}/set_pen", SetPen, self._set_pen),
            Answering(f"{name}/teleport_relative", TeleportRelative, self._teleport_relative),
            Answering(f"{name}/teleport_absolute", TeleportAbsolute, self._teleport_absolute),
        ]

    def publish(self) -> None:
        """Say where the turtle is, how it moves, and what is drawn under it."""
        turtle, velocity = self.turtle, self.turtle.velocity
        try:
            self._pose.publish(Pose(turtle.x, turtle.y, turtle.theta, turtle.speed, velocity.turn))
            self._colour.publish(Color(*turtle.colour))
        except rospy.ROSException:  # a turtle that leaves may be in the middle of a sentence
            if not self._closed:
                raise

    def close(self) -> None:
        """Take the turtle off the graph."""
        self._closed = True
        for service in self._services:
            service.shutdown()
        topics: list[Any] = [self._ordered, self._pose, self._colour]
        for topic in topics:
            topic.unregister()

    def _obey(self, message: Any) -> None:  # noqa: ANN401 -- a class that catkin generates
        forward, sideways, turn = message.linear.x, message.linear.y, message.angular.z
        if not sound(forward, sideways, turn):
            rospy.logwarn_throttle(1.0, f"{self.turtle.name}: a velocity that is no finite number is ignored")
            return
        self.turtle.velocity = Velocity(forward, sideways, turn, time.monotonic())

    def _set_pen(self, request: Any) -> SetPenResponse:  # noqa: ANN401
        pen = Pen((request.r, request.g, request.b), request.width, not request.off)
        self._in_tick(lambda: setattr(self.turtle, "pen", pen))
        return SetPenResponse()

    def _teleport_absolute(self, request: Any) -> TeleportAbsoluteResponse:  # noqa: ANN401
        x, y, theta = _sound(request.x, request.y, request.theta)
        self._in_tick(lambda: self.turtle.teleport(self._paper, x, y, theta))
        return TeleportAbsoluteResponse()

    def _teleport_relative(self, request: Any) -> TeleportRelativeResponse:  # noqa: ANN401
        distance, angle = _sound(request.linear, request.angular)
        self._in_tick(lambda: self.turtle.leap(self._paper, distance, angle))
        return TeleportRelativeResponse()


def _sound(*numbers: float) -> tuple[float, ...]:
    if not sound(*numbers):
        raise Refused("A turtle cannot be where a number is not finite.")
    return numbers
