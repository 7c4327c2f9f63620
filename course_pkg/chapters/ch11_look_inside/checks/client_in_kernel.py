"""An object of the student's client class in the kernel, and functions that break its connection."""

from __future__ import annotations

import socket
import struct
import threading
from contextlib import suppress
from types import TracebackType

from course_pkg.checking import CheckContext, Its
from course_pkg.checking.assertions import Hints
from course_pkg.checking.result import Result

KERNEL_CODE = """
import gc
import socket
import sys

import rospy

lookups = []


def record_lookups():
    '''Record each lookup that this process sends to the master; Python code cannot remove an audit hook.'''
    sys.addaudithook(
        lambda event, args: event == "http.client.send"
        and b">lookupService<" in bytes(args[1])
        and lookups.append(event)
    )


def make_client(kind, service):
    global client, service_name
    client, service_name = kind(service), rospy.resolve_name(service)


def measured(kind, *sides):
    answer = client.measure(*sides)
    return {"volume": answer.volume} if hasattr(answer, "volume") else answer


def measured_by_another(kind, service, *sides):
    kind(service).measure(*sides)


def break_sending():
    for proxy in kept_proxies():
        proxy.transport.socket.shutdown(socket.SHUT_RDWR)


def break_transport():
    for proxy in kept_proxies():
        proxy.transport.close()


def kept_proxies():
    # A proxy can be in an attribute of the client, or in a list or another object of the client.
    gc.unfreeze()  # After gc.freeze(), get_objects() would not return the older objects.
    proxies = [each for each in gc.get_objects() if issubclass(type(each), rospy.ServiceProxy)]
    return [each for each in proxies if each.transport and each.resolved_name == service_name]
"""


class Client:
    """An object of the student's class `kind` in the kernel; the object calls the service `name`."""

    def __init__(self, context: CheckContext, kind: str, name: str) -> None:
        self._context, self._kind = context, kind
        self.sides: list[float] = []  # These are the sides of the last box in m.
        self._measured = 0
        context.prepare(KERNEL_CODE)
        made = context.run("make_client", Its(kind), name, worded=f"{kind}(service)")
        context.require("an object of your class can be created", holds=made.returned() is None)

    def measure(self, hints: Hints) -> Result:
        """Call the method measure with random sides; every second call repeats the previous sides.

        If the client returns a complete response, the result is a dict with the volume.
        """
        if self._measured % 2 == 0:
            self.sides = self._context.random.numbers(3, 0.5, 9.0)
        self._measured += 1
        worded = "measure(length, width, height)"
        return self._context.run(
            "measured", Its(self._kind), *self.sides, within=3.0, hints=hints, worded=worded
        )


class ResettingPort:
    """A program that listens at the old address of a server.

    The program does not implement TCPROS, and resets each connection.
    """

    def __init__(self, uri: str) -> None:
        self.connections = 0
        self._listener = socket.create_server(("127.0.0.1", int(uri.rpartition(":")[2])))

    def __enter__(self) -> ResettingPort:
        threading.Thread(target=self._reset, daemon=True).start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _reset(self) -> None:
        with suppress(OSError):  # When the listening socket is closed, accept() raises OSError.
            while True:
                connection, _ = self._listener.accept()
                self.connections += 1
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                connection.close()
