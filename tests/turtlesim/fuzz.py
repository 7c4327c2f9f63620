"""A client that sends random calls with unusual values, and incomplete requests."""

from __future__ import annotations

import math
import os
import random
import socket
import struct
import time
from collections.abc import Callable
from contextlib import suppress
from urllib.parse import urlparse

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim.msg import Pose
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative

from course_pkg.ros import MasterClient, Node, master_uri

ODD_NUMBERS = (math.nan, math.inf, -math.inf, 0.0, -0.0, 1e-45, 3.4e38, -3.4e38, math.pi, -math.pi)
ODD_NAMES = (
    "",
    " ",
    "turtle1",
    "a/b",
    "/x",
    "//",
    "1",
    "ä",
    "~t",
    "a b",
    "x" * 300,
    "a\0b",
    "🐢",
    "t/",
    "con",
)
MOST = 12  # If there are more turtles than `MOST`, the fuzzer resets the simulator.


class Fuzzer:
    """Chooses random actions on the turtle simulator, and executes them.

    `refused` is the number of calls that the simulator has refused.
    """

    def __init__(self, node: Node, seed: int) -> None:
        self._node = node
        self._draw = random.Random(seed)  # noqa: S311 -- repeatable, and not secret
        self._names = ["turtle1"]
        self._publishers: dict[str, rospy.Publisher] = {}
        self.refused = 0

    def step(self) -> None:
        """Choose one action, and execute it."""
        deeds: list[Callable[[], None]] = [
            *(self._drive,) * 6,
            *(self._spawn, self._kill, self._pen, self._teleport, self._leap) * 2,
            self._cut_off,
            self._babble,
        ]
        if len(self._names) > MOST:
            self._reset()
        self._draw.choice(deeds)()

    def number(self) -> float:
        """Return a random number; on average, one number in three is unusual, such as NaN."""
        return self._draw.choice(ODD_NUMBERS) if self._draw.random() < 1 / 3 else self._draw.uniform(-20, 20)

    def _turtle(self) -> str:
        return self._draw.choice(self._names)

    def _call(self, name: str, kind: object, *values: object) -> object:
        try:
            return self._node.call(name, kind, *values, timeout=10)
        except rospy.ServiceException:
            self.refused += 1
            return None

    def _drive(self) -> None:
        topic = f"/{self._turtle()}/cmd_vel"
        if topic not in self._publishers:
            self._publishers[topic] = rospy.Publisher(topic, Twist, queue_size=1)
        order = Twist()
        order.linear.x, order.linear.y, order.angular.z = self.number(), self.number(), self.number()
        self._publishers[topic].publish(order)

    def _spawn(self) -> None:
        name = self._draw.choice(ODD_NAMES)
        made = self._call("/spawn", Spawn, self.number(), self.number(), self.number(), name)
        if made is not None:
            self._names.append(made.name.strip("/"))  # type: ignore[attr-defined]

    def _kill(self) -> None:
        name = self._draw.choice([*self._names, *ODD_NAMES])
        if name != "turtle1" and self._call("/kill", Kill, name) is not None and name in self._names:
            self._names.remove(name)

    def _pen(self) -> None:
        values = [self._draw.randrange(256) for _ in range(5)]
        self._call(f"/{self._turtle()}/set_pen", SetPen, *values)

    def _teleport(self) -> None:
        values = self.number(), self.number(), self.number()
        self._call(f"/{self._turtle()}/teleport_absolute", TeleportAbsolute, *values)

    def _leap(self) -> None:
        self._call(f"/{self._turtle()}/teleport_relative", TeleportRelative, self.number(), self.number())

    def _reset(self) -> None:
        self._call(self._draw.choice(["/reset", "/clear"]), Empty)
        self._call("/reset", Empty)
        self._names = ["turtle1"]
        for publisher in self._publishers.values():
            publisher.unregister()
        self._publishers.clear()

    def _cut_off(self) -> None:
        """Send an incomplete request, and close the connection."""
        pairs = [b"service=/spawn", b"callerid=/rude", b"md5sum=" + Spawn._md5sum.encode()]
        body = b"".join(struct.pack("<I", len(pair)) + pair for pair in pairs)
        request = struct.pack("<IfffI", 16, 1.0, 1.0, 0.0, 0)
        whole = struct.pack("<I", len(body)) + body + request
        self._send(whole[: self._draw.randrange(len(whole))])

    def _babble(self) -> None:
        self._send(self._draw.randbytes(self._draw.randrange(200)))

    def _send(self, data: bytes) -> None:
        address = urlparse(MasterClient(master_uri()).lookup_service("/spawn") or "")
        with (
            suppress(OSError),
            socket.create_connection((address.hostname or "", address.port or 0), 5) as sock,
        ):
            sock.sendall(data)


def sane(node: Node) -> None:
    """Assert that turtle1 is in the middle after a reset, and that turtle1 can be teleported."""
    node.call("/reset", Empty, timeout=10)
    with node.subscribe("/turtle1/pose", Pose) as heard:
        heard.wait(1)
        deadline = time.monotonic() + 10
        while abs(heard.messages[-1].x - 5.544444561) > 1e-6 and time.monotonic() < deadline:
            time.sleep(0.01)
        assert abs(heard.messages[-1].x - 5.544444561) < 1e-6, heard.messages[-1]
        node.call("/turtle1/teleport_absolute", TeleportAbsolute, 2.0, 3.0, 0.5)
        while round(heard.messages[-1].x, 3) != 2.0 and time.monotonic() < deadline:
            time.sleep(0.01)
        assert [round(value, 3) for value in (heard.messages[-1].x, heard.messages[-1].y)] == [2.0, 3.0]


def resident(pid: int) -> float:
    """Return the resident memory of a process in MiB."""
    with open(f"/proc/{pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
