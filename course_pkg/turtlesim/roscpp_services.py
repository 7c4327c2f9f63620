"""Services and names with the behaviour of a roscpp node.

rospy adds "service cannot process request: …" to an error message. A roscpp server sends only the error
message of the callback; this message may be empty. The connection header of a roscpp server contains the
types of request and response; rospy's header does not. Source of the protocol:
http://wiki.ros.org/ROS/TCPROS.
"""

from __future__ import annotations

import re
import socket
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

import genpy
import rospy
from rospy.impl import tcpros_base
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_service import ServiceImpl, TCPService, service_connection_handler

if TYPE_CHECKING:
    from course_pkg.types import ServiceClass

Request = TypeVar("Request", bound=genpy.Message)

FIRST = re.compile(r"[A-Za-z/~]")
FURTHER = re.compile(r"[A-Za-z0-9_/]")


class Refused(rospy.ServiceException):
    """Refuses a request with an error message, which may be empty."""


def refuse_like_roscpp() -> None:
    """Make this process refuse connections with roscpp's error messages.

    Call init_node() before this function.
    """
    tcpros_base.start_tcpros_server()
    server = tcpros_base._tcpros_server
    assert server is not None
    server.service_connection_handler = _accept


class _Protocol(TCPService):
    """The protocol of a service, with the connection header of a roscpp server."""

    def __init__(self, name: str, kind: ServiceClass) -> None:
        TCPService.__init__(self, name, kind)

    def get_header_fields(self) -> dict[str, str]:
        """Return the fields of the connection header that roscpp sends."""
        kind = self.service_class
        return {
            "callerid": rospy.get_name(),
            "md5sum": kind._md5sum,
            "request_type": kind._request_class._type,
            "response_type": kind._response_class._type,
            "type": kind._type,
        }


class RoscppService(ServiceImpl):
    """A service that is registered immediately; its handler returns a response, or raises Refused."""

    def __init__(self, name: str, kind: ServiceClass, handler: Callable[[Request], genpy.Message]) -> None:
        ServiceImpl.__init__(self, name, kind, handler)
        self.protocol = _Protocol(self.resolved_name, kind)
        get_service_manager().register(self.resolved_name, self)

    def _write_service_error(self, transport: TCPROSTransport, err_msg: str) -> None:
        message = err_msg
        for prefix in ("service cannot process request: ", "error processing request: "):
            message = message.removeprefix(prefix)
        ServiceImpl._write_service_error(self, transport, message)


def _accept(sock: socket.socket, address: tuple[str, int], header: dict[str, str]) -> str | None:
    """Accept a connection and return None, or return the error message for the client."""
    if any(field not in header for field in ("md5sum", "service", "callerid")):
        return "bogus tcpros header. did not have required elements: md5sum, service, callerid"
    name, requested = header["service"], header["md5sum"]
    service = get_service_manager().get_service(name)
    if service is None:
        return f"received a tcpros connection for a nonexistent service [{name}]."
    md5 = service.service_class._md5sum
    if requested not in ("*", md5):
        return (
            f"client wants service {name} to have md5sum {requested}, but it has {md5}. Dropping connection."
        )
    refusal: str | None = service_connection_handler(sock, address, header)
    return refusal


def name_error(name: str) -> str:
    """Return roscpp's error message if `name` is not a valid graph resource name, else ""."""
    message_end = f"Graph Resource Name [{name}].  "
    if not FIRST.match(name):
        return (
            f"Character [{name[:1]}] is not valid as the first character in {message_end}"
            "Valid characters are a-z, A-Z, / and in some cases ~."
        )
    for index, character in enumerate(name[1:], start=1):
        if not FURTHER.match(character):
            return (
                f"Character [{character}] at element [{index}] is not valid in {message_end}"
                "Valid characters are a-z, A-Z, 0-9, / and _."
            )
    if name.startswith("~"):
        return f"Using ~ names with NodeHandle methods is not allowed. (name = [{name}])"
    return ""
