"""Services that answer as those of a roscpp node do.

rospy words a failure itself ("service cannot process request: …") and leaves two fields out of its connection
header. A roscpp server says just what its callback says, which may be nothing at all, and names the types
of both halves. What goes over the wire: http://wiki.ros.org/ROS/TCPROS.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from rospy.impl import tcpros_base
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_service import ServiceImpl, TCPService, service_connection_handler


class Refused(rospy.ServiceException):
    """The request is refused; the client is told the words, which may be none."""


def word_refusals() -> None:
    """Have this process refuse a connection in roscpp's words; call it after init_node()."""
    tcpros_base.start_tcpros_server()
    server: Any = tcpros_base._tcpros_server
    server.service_connection_handler = _connected


class AnsweringProtocol(TCPService):
    """What the connection header says."""

    def get_header_fields(self) -> dict[str, str]:
        """Return the fields that roscpp sends."""
        kind = self.service_class
        return {
            "callerid": rospy.get_name(),
            "md5sum": kind._md5sum,
            "request_type": kind._request_class._type,
            "response_type": kind._response_class._type,
            "type": kind._type,
        }


class Answering(ServiceImpl):
    """A service, registered at once. `answer` returns a response, or raises Refused."""

    def __init__(self, name: str, kind: Any, answer: Callable[[Any], Any]) -> None:  # noqa: ANN401
        super().__init__(name, kind, answer)  # type: ignore[no-untyped-call]
        self.protocol: Any = AnsweringProtocol(self.resolved_name, kind)  # type: ignore[no-untyped-call]
        get_service_manager().register(self.resolved_name, self)

    def _write_service_error(self, transport: Any, err_msg: str) -> None:  # noqa: ANN401
        words = err_msg
        for prefix in ("service cannot process request: ", "error processing request: "):
            words = words.removeprefix(prefix)
        super()._write_service_error(transport, words)  # type: ignore[no-untyped-call]


def _connected(sock: Any, address: Any, header: dict[str, str]) -> str | None:  # noqa: ANN401
    """Take a connection over, or return why not."""
    if any(field not in header for field in ("md5sum", "service", "callerid")):
        return "bogus tcpros header. did not have required elements: md5sum, service, callerid"
    name, asked = header["service"], header["md5sum"]
    service = get_service_manager().get_service(name)
    if service is None:
        return f"received a tcpros connection for a nonexistent service [{name}]."
    md5 = service.service_class._md5sum
    if asked not in ("*", md5):
        return f"client wants service {name} to have md5sum {asked}, but it has {md5}. Dropping connection."
    refusal: str | None = service_connection_handler(sock, address, header)
    return refusal
