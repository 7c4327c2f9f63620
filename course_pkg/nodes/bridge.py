"""The node `bridge`: lets programs that know nothing of ROS call services, by JSON over a websocket.

It speaks of rosbridge's protocol the part that calls services, and binds to this computer alone:
https://github.com/RobotWebTools/rosbridge_suite/blob/ros1/ROSBRIDGE_PROTOCOL.md, 3.4.6 and 3.4.7.
"""

from __future__ import annotations

import asyncio
import base64
import json
import signal
from typing import Any

import genpy
import rospy
import rosservice
import tornado.httpserver
import tornado.netutil
import tornado.web
import tornado.websocket

from course_pkg.errors import GraphError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.stepping import number_parameter, step_onto_graph

PORT = 9090  # rosbridge's own; `_port:=0` takes any that is free
PATIENCE = 10.0  # s for one call
LARGEST = 1 << 20  # bytes of a message

Words = dict[str, Any]  # a message of the protocol


def answered(text: str | bytes) -> Words:
    """Return what the protocol answers to one message: a response, or a status that says what is wrong."""
    try:
        asked = json.loads(text)
    except ValueError as error:
        return _complaint(f"no JSON: {error}")
    if not isinstance(asked, dict) or asked.get("op") != "call_service" or not asked.get("service"):
        return _complaint("this bridge knows one op, call_service, with the name of a service")
    name = str(asked["service"])
    try:
        values: Any = _called(name, asked.get("args", {}))
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
    ident = {"id": asked["id"]} if "id" in asked else {}
    return {"op": "service_response", **ident, "service": name, "values": values, "result": result}


def _called(name: str, args: Any) -> Words:  # noqa: ANN401 -- whatever a stranger sends
    """Call a service with fields by name or by position, and return the fields of its response."""
    cls = rosservice.get_service_class_by_name(name)
    if cls is None:
        raise ValueError(f"service [{name}] is of a type that is not known here")
    if not isinstance(args, (dict, list)):
        raise ValueError("args is neither an object, by name, nor an array, by position")
    request = cls._request_class()
    genpy.message.fill_message_args(request, [args] if isinstance(args, dict) else args)
    response: Words = _fields(BoundedProxy(name, cls, timeout=PATIENCE)(request))
    return response


def _fields(value: Any) -> Any:  # noqa: ANN401 -- a message, or what is in one
    if isinstance(value, genpy.Message):
        return {name: _fields(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, genpy.TVal):
        return {"secs": value.secs, "nsecs": value.nsecs}
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    return [_fields(item) for item in value] if isinstance(value, (list, tuple)) else value


def _complaint(words: str) -> Words:
    return {"op": "status", "level": "error", "msg": words}


class Line(tornado.websocket.WebSocketHandler):
    """One connection. Calls are made beside each other, each on a thread."""

    def data_received(self, chunk: bytes) -> None:
        """Take nothing: a websocket is upgraded from a request without a body."""

    async def on_message(self, message: str | bytes) -> None:
        """Answer one message, unless the other end has hung up meanwhile."""
        reply = await asyncio.get_running_loop().run_in_executor(None, answered, message)
        if self.ws_connection is not None:
            await self.write_message(json.dumps(reply))


async def _serve(port: int) -> None:
    over = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, over.set)
    sockets = tornado.netutil.bind_sockets(port, "127.0.0.1")
    application = tornado.web.Application([("/.*", Line)], websocket_max_message_size=LARGEST)
    server = tornado.httpserver.HTTPServer(application)
    server.add_sockets(sockets)
    rospy.loginfo("ws://localhost:%d", sockets[0].getsockname()[1])
    await over.wait()
    server.stop()


def main() -> None:
    """Serve until Ctrl-C."""
    if not step_onto_graph("bridge"):
        return
    port = int(number_parameter("~port", PORT, 0, 65535))
    try:
        asyncio.run(_serve(port))
    except OSError as error:
        rospy.logfatal("Port %d is not to be had (%s). Choose another: _port:=0.", port, error.strerror)
        raise SystemExit(1) from error
    rospy.signal_shutdown("told to end")
