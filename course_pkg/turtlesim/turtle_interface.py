"""The topics and services of a turtle.

If a publisher has a queue, rospy starts one thread for each subscriber. The thread wakes up for each message.
With 1,500 messages per second, this would take most of the CPU time. Without a queue, rospy writes each
message directly. The publisher then has to wait if a subscriber does not read.

The publishers of a turtle use no queue. They write a message directly if the connection's buffer has space,
and drop the message otherwise.
"""

from __future__ import annotations

import select
import time
from collections.abc import Callable

import rospy
from geometry_msgs.msg import Twist
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_service import ServiceImpl
from rospy.topics import Topic
from turtlesim.msg import Color, Pose
from turtlesim.srv import (
    SetPen,
    SetPenRequest,
    SetPenResponse,
    TeleportAbsolute,
    TeleportAbsoluteRequest,
    TeleportAbsoluteResponse,
    TeleportRelative,
    TeleportRelativeRequest,
    TeleportRelativeResponse,
)

from course_pkg.turtlesim.canvas import Canvas
from course_pkg.turtlesim.roscpp_services import Refused, RoscppService
from course_pkg.turtlesim.world import Pen, Turtle, Velocity, all_finite

InTick = Callable[[Callable[[], None]], None]


class TurtleInterface:
    """The topics and services of one turtle, until close() is called.

    The function `in_tick` runs another function between two ticks, and waits for its end.
    """

    def __init__(self, turtle: Turtle, canvas: Canvas, in_tick: InTick) -> None:
        self.turtle = turtle
        self._canvas = canvas
        self._in_tick = in_tick
        self._closed = False
        name = turtle.name
        self._pose = rospy.Publisher(f"{name}/pose", Pose, queue_size=1)
        self._colour = rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1)
        for publisher in (self._pose, self._colour):
            publish_without_waiting(publisher)
        self._commands = rospy.Subscriber(
            f"{name}/cmd_vel", Twist, self._set_velocity, queue_size=1, tcp_nodelay=True
        )
        self._services: list[ServiceImpl] = [
            RoscppService(f"{name}/set_pen", SetPen, self._set_pen),
            RoscppService(f"{name}/teleport_relative", TeleportRelative, self._teleport_relative),
            RoscppService(f"{name}/teleport_absolute", TeleportAbsolute, self._teleport_absolute),
        ]

    def publish(self) -> None:
        """Publish the turtle's pose and velocity, and the colour under the turtle."""
        turtle, velocity = self.turtle, self.turtle.velocity
        try:
            self._pose.publish(Pose(turtle.x, turtle.y, turtle.theta, turtle.speed, velocity.turn))
            self._colour.publish(Color(*turtle.colour))
        except rospy.ROSException:  # Another thread may call close() at the same time.
            if not self._closed:
                raise

    def close(self) -> None:
        """Unregister the topics and the services."""
        self._closed = True
        for service in self._services:
            service.shutdown()
        topics: list[Topic] = [self._commands, self._pose, self._colour]
        for topic in topics:
            topic.unregister()

    def _set_velocity(self, message: Twist) -> None:
        forward, sideways, turn = message.linear.x, message.linear.y, message.angular.z
        if not all_finite(forward, sideways, turn):
            rospy.logwarn_throttle(1.0, f"{self.turtle.name}: ignored a velocity that is not finite")
            return
        self.turtle.velocity = Velocity(forward, sideways, turn, time.monotonic())

    def _set_pen(self, request: SetPenRequest) -> SetPenResponse:
        pen = Pen((request.r, request.g, request.b), request.width, not request.off)
        self._in_tick(lambda: setattr(self.turtle, "pen", pen))
        return SetPenResponse()

    def _teleport_absolute(self, request: TeleportAbsoluteRequest) -> TeleportAbsoluteResponse:
        x, y, theta = _require_finite(request.x, request.y, request.theta)
        self._in_tick(lambda: self.turtle.teleport(self._canvas, x, y, theta))
        return TeleportAbsoluteResponse()

    def _teleport_relative(self, request: TeleportRelativeRequest) -> TeleportRelativeResponse:
        distance, angle = _require_finite(request.linear, request.angular)
        self._in_tick(lambda: self.turtle.teleport_relative(self._canvas, distance, angle))
        return TeleportRelativeResponse()


def _require_finite(*numbers: float) -> tuple[float, ...]:
    if not all_finite(*numbers):
        raise Refused("A position or an angle is not finite.")
    return numbers


def publish_without_waiting(publisher: rospy.Publisher) -> None:
    """Make the publisher write its messages directly, without waiting for a subscriber."""
    impl = publisher.impl
    original = impl.add_connection
    impl.queue_size = None

    def add_connection(connection: TCPROSTransport) -> bool:
        vars(connection)["write_data"] = _Writer(connection)
        return bool(original(connection))

    impl.add_connection = add_connection


class _Writer:
    """Writes to the connection of one subscriber, if the send buffer has space."""

    def __init__(self, connection: TCPROSTransport) -> None:
        assert connection.socket is not None
        self._write: Callable[[bytes], bool] = connection.write_data
        self._room = select.poll()
        self._room.register(connection.socket, select.POLLOUT)

    def __call__(self, data: bytes) -> bool:
        """Write the bytes `data`; drop them if the send buffer has no space.

        Raises rospy's error if the connection is broken.
        """
        if self._room.poll(0):
            return self._write(data)
        return True
