"""Where rospy's service calls are listened to, on both ends, for the flight recorder.

A call is known by what is on the wire: the connection it went over, named by its TCP ports, and its number
there. Both ends count alike, because TCP neither loses nor reorders. rospy has no hooks for any of this, so a
few of its methods are replaced; a rospy that is built differently is left alone.
"""

from __future__ import annotations

import time
from contextlib import suppress
from types import TracebackType
from typing import Any

import rospy
from rospy.impl import tcpros_service
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_service import ServiceImpl, ServiceProxy

from course_pkg.graph.events import CONNECT, ERROR, HANDLER, LOOKUP, REQUEST, RESPONSE, WAIT
from course_pkg.graph.taps import MADE_HERE, Method, Tap, Transport, put_all
from course_pkg.graph.trace import END, CallMark, Connection, Mark, recorder

BLIND = "service calls: this rospy makes and answers them otherwise"
NO_ANSWER = "ended without an answer"


def tap_services() -> bool:
    """Have this process's calls and handlers recorded; say whether it could be done."""
    taps = (
        Tap(ServiceProxy, "call", ("self", "args", "kwds"), _calling, uses=[MADE_HERE]),
        Tap(ServiceProxy, "_get_service_uri", ("self", "request"), _looking_up),
        Tap(ServiceImpl, "_handle_request", ("self", "transport", "request"), _handling),
    )
    done = put_all(taps, tcpros_service, RecordedTransport)
    if not done:
        recorder().blind.add(BLIND)
    return done


def service_transport(protocol: Any, name: str) -> TCPROSTransport:  # noqa: ANN401
    """Return a client's connection as rospy would make one now, which is recorded if anything is."""
    made: TCPROSTransport = getattr(tcpros_service, MADE_HERE)(protocol, name)
    return made


class RecordedCall:
    """The block in which this thread makes a call."""

    __slots__ = ("_mark", "_service")

    def __init__(self, service: str) -> None:
        self._service = service

    def __enter__(self) -> None:
        self._mark = recorder().begin_call(self._service)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None and not self._mark.settled:
            self._mark.settle(ERROR, f"{type(error).__name__}: {error}", answered=False)
        recorder().here.call = None
        recorder().end(self._mark)


class RecordedLookup:
    """The block in which this thread asks the master for the address of the service that it calls."""

    __slots__ = ("_part",)

    def __enter__(self) -> None:
        self._part = _part(recorder().here.call, LOOKUP)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._part[END] = time.monotonic()


class RecordedTransport(Transport):  # type: ignore[misc]  # rospy has no types
    """One end of a service's connection, which takes down what passes."""

    serving = False
    connection: Connection | None = None
    exchanges = 0
    handled: Mark | None = None  # at the server, the request that is being worked on

    def set_socket(self, sock: Any, endpoint_id: str) -> None:  # noqa: ANN401 -- rospy has no types
        """Take over a connection that was accepted: only servers do."""
        super().set_socket(sock, endpoint_id)
        self.serving = True
        with suppress(OSError):  # it may have gone already
            self.connection = (sock.getpeername(), self.local_endpoint[1])

    def connect(self, dest_addr: str, dest_port: int, endpoint_id: str, timeout: float | None = None) -> None:
        """Connect and exchange headers, at the client."""
        part = _part(recorder().here.call, CONNECT)
        try:
            super().connect(dest_addr, dest_port, endpoint_id, timeout)
        finally:
            part[END] = time.monotonic()
        self.connection = (self.local_endpoint, dest_port)

    def send_message(self, msg: Any, seq: int) -> None:  # noqa: ANN401
        """Send a request at the client, or a response at the server."""
        call = None if self.serving else recorder().here.call
        if call is None:
            super().send_message(msg, seq)
            return
        self.exchanges += 1
        call.peer = self.callerid_pub
        if self.connection is not None:
            call.wire = (self.connection, self.exchanges, self.callerid_pub)
        part = call.begin(REQUEST)
        try:
            super().send_message(msg, seq)
        finally:
            part[END] = time.monotonic()

    def receive_once(self) -> Any:  # noqa: ANN401
        """Wait for a request at the server, or for a response at the client."""
        call = None if self.serving else recorder().here.call
        if call is None:
            return super().receive_once()
        part = call.begin(WAIT)
        try:
            responses = super().receive_once()
        except BaseException as error:
            part[END] = time.monotonic()
            if isinstance(error, rospy.ServiceException):  # the server answered, in words
                call.settle(ERROR, str(error))
            raise
        part[END] = time.monotonic()
        call.settle(RESPONSE)
        return responses

    def write_data(self, data: bytes) -> Any:  # noqa: ANN401
        """Send bytes; at the server they are an answer, and what the handler does is over."""
        if self.handled is not None:
            recorder().end(self.handled, _refusal(data))
        return super().write_data(data)


def _calling(bare: Method) -> Method:
    def call(self: ServiceProxy, *args: Any, **kwds: Any) -> Any:  # noqa: ANN401
        with RecordedCall(self.resolved_name):
            return bare(self, *args, **kwds)

    return call


def _looking_up(bare: Method) -> Method:
    def _get_service_uri(self: ServiceProxy, request: Any) -> Any:  # noqa: ANN401
        with RecordedLookup():
            return bare(self, request)

    return _get_service_uri


def _handling(bare: Method) -> Method:
    def _handle_request(self: ServiceImpl, transport: Any, request: Any) -> None:  # noqa: ANN401
        if not isinstance(transport, RecordedTransport):
            bare(self, transport, request)
            return
        transport.exchanges += 1
        caller = str(transport.endpoint_id)
        recorder().tally.begun(self.resolved_name, caller)
        wires = [(transport.connection, transport.exchanges, caller)] if transport.connection else []
        mark = recorder().begin(HANDLER, self.resolved_name, caller, wires)
        transport.handled = mark
        try:
            bare(self, transport, request)
        finally:
            transport.handled = None
            recorder().end(mark, NO_ANSWER)  # no matter if an answer was sent: then it is over already
            recorder().tally.ended(self.resolved_name, caller)

    return _handle_request


def _part(call: CallMark | None, kind: str) -> list[Any]:
    """Return the mark for a part that begins; of no call, it is nobody's."""
    return [kind, 0.0, None] if call is None else call.begin(kind)


def _refusal(data: bytes) -> str:
    """Return the words with which a server refuses, after a byte 0 and their length; http://wiki.ros.org/ROS/TCPROS."""
    return data[5:].decode("utf-8", "replace") if data[:1] == b"\0" else ""
