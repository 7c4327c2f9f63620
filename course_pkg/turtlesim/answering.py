"""Services that answer as those of a roscpp node do.

rospy words a failure itself ("service cannot process request: …") and leaves two fields out of its connection
header. A roscpp server says just what its callback says, which may be nothing at all, and names the types
of both halves. What goes over the wire: http://wiki.ros.org/ROS/TCPROS.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_service import ServiceImpl, TCPService

OK = b"\x01"


class Refused(Exception):
    """The request is refused; the client is told the words, which may be none."""


class AnsweringProtocol(TCPService):  # type: ignore[misc] -- rospy has no types
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


class Answering(ServiceImpl):  # type: ignore[misc] -- rospy has no types
    """A service, registered at once. `answer` returns a response, or raises Refused."""

    def __init__(self, name: str, kind: Any, answer: Callable[[Any], Any]) -> None:  # noqa: ANN401
        super().__init__(name, kind, answer)
        self.protocol = AnsweringProtocol(self.resolved_name, kind)
        get_service_manager().register(self.resolved_name, self)

    def _handle_request(self, transport: Any, request: Any) -> None:  # noqa: ANN401
        try:
            response = self.handler(request)
        except Refused as refusal:
            self._write_service_error(transport, str(refusal))
            return
        self.seq += 1
        transport.write_buff.write(OK)
        transport.send_message(response, self.seq)
