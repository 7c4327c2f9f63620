"""The node `bridge`: programs without ROS call services with JSON messages over a websocket.

The bridge listens only on this computer. The bridge implements the service calls of the rosbridge protocol
(sections 3.4.6 and 3.4.7 of
https://github.com/RobotWebTools/rosbridge_suite/blob/ros1/ROSBRIDGE_PROTOCOL.md).
"""

from __future__ import annotations

import asyncio
import base64
import json
import signal
from typing import TypeAlias

import genpy
import rospy
import rosservice
import tornado.httpserver
import tornado.netutil
import tornado.web
import tornado.websocket

from course_pkg.errors import GraphError
from course_pkg.ros.node.program import number_parameter, start_node
from course_pkg.ros.node.proxy import BoundedProxy

PORT = 9090  # rosbridge uses this port by default; with `_port:=0`, a free port is used.
TIMEOUT = 10.0  # TIMEOUT is the time limit in s for one call.
LARGEST = 1 << 20  # LARGEST is the maximum number of bytes of a message.

JSON: TypeAlias = "bool | int | float | str | list[JSON] | dict[str, JSON] | None"


def answered(text: str | bytes) -> dict[str, JSON]:
    """Return the reply to one message: a response, or a status with an error message."""
    try:
        request = json.loads(text)
    except ValueError as error:
        return _error(f"the text is not valid JSON: {error}")
    if not isinstance(request, dict) or request.get("op") != "call_service" or not request.get("service"):
        return _error('the message must be an object with "op": "call_service" and the name of a service')
    name = str(request["service"])
    try:
        values: JSON = _called(name, request.get("args", {}))
        result = True
    except (
        rospy.ROSException,
        rospy.ServiceException,
        rosservice.ROSServiceException,
        genpy.MessageException,
        GraphError,
        ValueError,
    ) as error:
        values, result = str(error), False
    ident = {"id": request["id"]} if "id" in request else {}
    return {"op": "service_response", **ident, "service": name, "values": values, "result": result}


def _called(name: str, args: JSON) -> JSON:
    """Call a service with named or positional fields, and return the fields of its response."""
    cls = rosservice.get_service_class_by_name(name)
    if cls is None:
        raise ValueError(f"the bridge does not know the type of service [{name}]")
    if not isinstance(args, (dict, list)):
        raise ValueError(
            "args must be an object with the fields by name, or an array with the fields by position"
        )
    request = cls._request_class()
    genpy.message.fill_message_args(request, [args] if isinstance(args, dict) else args)
    return _fields(BoundedProxy(name, cls, timeout=TIMEOUT)(request))


def _fields(value: genpy.Message | genpy.TVal | bytes | JSON) -> JSON:
    if isinstance(value, genpy.Message):
        return {name: _fields(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, genpy.TVal):
        return {"secs": value.secs, "nsecs": value.nsecs}
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    return [_fields(item) for item in value] if isinstance(value, (list, tuple)) else value


def _error(message: str) -> dict[str, JSON]:
    return {"op": "status", "level": "error", "msg": message}


class Connection(tornado.websocket.WebSocketHandler):
    """One connection of a client; each call runs on a separate thread."""

    def data_received(self, chunk: bytes) -> None:
        """Do nothing, because the request that opens a websocket has no body."""

    async def on_message(self, message: str | bytes) -> None:
        """Reply to one message, unless the client has closed the connection in the meantime."""
        reply = await asyncio.get_running_loop().run_in_executor(None, answered, message)
        if self.ws_connection is not None:
            await self.write_message(json.dumps(reply))


async def _serve(port: int) -> None:
    over = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, over.set)
    sockets = tornado.netutil.bind_sockets(port, "127.0.0.1")
    application = tornado.web.Application([("/.*", Connection)], websocket_max_message_size=LARGEST)
    server = tornado.httpserver.HTTPServer(application)
    server.add_sockets(sockets)
    rospy.loginfo("ws://localhost:%d", sockets[0].getsockname()[1])
    await over.wait()
    server.stop()


def main() -> None:
    """Serve until Ctrl-C."""
    if not start_node("bridge"):
        return
    port = int(number_parameter("~port", PORT, 0, 65535))
    try:
        asyncio.run(_serve(port))
    except OSError as error:
        rospy.logfatal(
            "Port %d is not available (%s). Choose a different port; with _port:=0, the node uses "
            "any free port.",
            port,
            error.strerror,
        )
        raise SystemExit(1) from error
    rospy.signal_shutdown("the bridge has ended")
