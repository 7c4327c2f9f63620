"""The recorder's hooks for service calls, in rospy's clients and servers.

A call is identified by its connection (the TCP ports) and by its number on this connection. Client and server
count the calls in the same order, because TCP does not lose or reorder data.

rospy has no hooks for calls, so this module replaces a few methods of rospy. If the installed release of
rospy has different methods, the module changes nothing.
"""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType
from typing import Concatenate, ParamSpec, TypeVar

import genpy
import rospy
from rospy.impl import tcpros_service
from rospy.impl.tcpros_base import TCPROSTransport, TCPROSTransportProtocol
from rospy.impl.tcpros_service import ServiceImpl, ServiceProxy

from course_pkg.ros.trace.hooks import TRANSPORT, Hook, install_all
from course_pkg.ros.trace.recorder import CallPart, CallSpan, Connection, Span, recorder
from course_pkg.ros.trace.recording import CONNECT, ERROR, HANDLER, LOOKUP, REQUEST, RESPONSE, WAIT

UNSUPPORTED = "service calls: this rospy makes and answers them in another way"
NO_ANSWER = "ended without an answer"

P = ParamSpec("P")
R = TypeVar("R")


def hook_services() -> bool:
    """Record this process's calls and handlers from now on; return whether the hooks fit rospy."""
    hooks = (
        Hook(ServiceProxy, "call", ("self", "args", "kwds"), _recording_call, uses=[TRANSPORT]),
        Hook(ServiceProxy, "_get_service_uri", ("self", "request"), _recording_lookup),
        Hook(ServiceImpl, "_handle_request", ("self", "transport", "request"), _recording_handler),
    )
    done = install_all(hooks, tcpros_service, RecordedTransport)
    if not done:
        recorder().unsupported.add(UNSUPPORTED)
    return done


def service_transport(protocol: TCPROSTransportProtocol, name: str) -> TCPROSTransport:
    """Return a new client connection, as rospy's ServiceProxy creates it.

    If the hooks are installed, the connection records the calls.
    """
    made: TCPROSTransport = getattr(tcpros_service, TRANSPORT)(protocol, name)
    return made


class RecordedCall:
    """Records a `with` block as a call of this thread."""

    __slots__ = ("_service", "_span")

    def __init__(self, service: str) -> None:
        self._service = service

    def __enter__(self) -> None:
        self._span = recorder().begin_call(self._service)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None and not self._span.result:
            self._span.finish(ERROR, f"{type(error).__name__}: {error}", answered=False)
        recorder().current.call = None
        recorder().end(self._span)


class RecordedLookup:
    """Records a `with` block as the lookup of a service's address at the master."""

    __slots__ = ("_part",)

    def __enter__(self) -> None:
        self._part = _begin_part(recorder().current.call, LOOKUP)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._part.end = time.monotonic()


class RecordedTransport(TCPROSTransport):
    """A client's or server's connection that records requests and responses."""

    serving = False
    connection: Connection | None = None
    exchanges = 0
    handling: Span | None = None  # In a server, this is the span of the handler that is running.

    def set_socket(self, sock: socket.socket, endpoint_id: str) -> None:
        """Use a connection that the server has accepted; clients do not call this method."""
        TCPROSTransport.set_socket(self, sock, endpoint_id)
        self.serving = True
        with suppress(OSError):  # The client may have closed the connection.
            self.connection = (sock.getpeername(), self.local_endpoint[1])

    def connect(self, dest_addr: str, dest_port: int, endpoint_id: str, timeout: float | None = None) -> None:
        """Connect a client to a server, and exchange headers."""
        part = _begin_part(recorder().current.call, CONNECT)
        try:
            TCPROSTransport.connect(self, dest_addr, dest_port, endpoint_id, timeout)
        finally:
            part.end = time.monotonic()
        self.connection = (self.local_endpoint, dest_port)

    def send_message(self, msg: genpy.Message, seq: int) -> None:
        """Send a request (in a client) or a response (in a server)."""
        call = None if self.serving else recorder().current.call
        if call is None:
            TCPROSTransport.send_message(self, msg, seq)
            return
        self.exchanges += 1
        call.peer = self.callerid_pub
        if self.connection is not None:
            call.transfer = (self.connection, self.exchanges, self.callerid_pub)
        part = call.begin(REQUEST)
        try:
            TCPROSTransport.send_message(self, msg, seq)
        finally:
            part.end = time.monotonic()

    def receive_once(self) -> list[genpy.Message]:
        """Wait for a request (in a server) or a response (in a client)."""
        call = None if self.serving else recorder().current.call
        received: list[genpy.Message]
        if call is None:
            received = TCPROSTransport.receive_once(self)
            return received
        part = call.begin(WAIT)
        try:
            received = TCPROSTransport.receive_once(self)
        except BaseException as error:
            part.end = time.monotonic()
            if isinstance(error, rospy.ServiceException):  # The server has sent an error message.
                call.finish(ERROR, str(error))
            raise
        part.end = time.monotonic()
        call.finish(RESPONSE)
        return received

    def write_data(self, data: bytes) -> bool:
        """Send bytes; in a server, the bytes are a response, so the handler has ended."""
        if self.handling is not None:
            recorder().end(self.handling, _error_message(data))
        return bool(TCPROSTransport.write_data(self, data))


def _recording_call(
    method: Callable[Concatenate[ServiceProxy, P], R],
) -> Callable[Concatenate[ServiceProxy, P], R]:
    def call(self: ServiceProxy, /, *args: P.args, **kwds: P.kwargs) -> R:
        with RecordedCall(self.resolved_name):
            return method(self, *args, **kwds)

    return call


def _recording_lookup(
    method: Callable[[ServiceProxy, genpy.Message], R],
) -> Callable[[ServiceProxy, genpy.Message], R]:
    def _get_service_uri(self: ServiceProxy, request: genpy.Message) -> R:
        with RecordedLookup():
            return method(self, request)

    return _get_service_uri


def _recording_handler(
    method: Callable[[ServiceImpl, TCPROSTransport, genpy.Message], R],
) -> Callable[[ServiceImpl, TCPROSTransport, genpy.Message], R]:
    def _handle_request(self: ServiceImpl, transport: TCPROSTransport, request: genpy.Message) -> R:
        if not isinstance(transport, RecordedTransport):
            return method(self, transport, request)
        transport.exchanges += 1
        caller = str(transport.endpoint_id)
        recorder().call_counter.begin(self.resolved_name, caller)
        transfers = [(transport.connection, transport.exchanges, caller)] if transport.connection else []
        span = recorder().begin(HANDLER, self.resolved_name, caller, transfers)
        transport.handling = span
        try:
            return method(self, transport, request)
        finally:
            transport.handling = None
            # This call has no effect if a response has already ended the span.
            recorder().end(span, NO_ANSWER)
            recorder().call_counter.end(self.resolved_name, caller)

    return _handle_request


def _begin_part(call: CallSpan | None, kind: str) -> CallPart:
    """Return a CallPart that begins now; if `call` is None, the CallPart is not recorded."""
    return CallPart(kind) if call is None else call.begin(kind)


def _error_message(data: bytes) -> str:
    """Return the error message of a server's response, or "" if the response is not an error.

    An error is a byte 0, the length (4 bytes), and the message. Source: http://wiki.ros.org/ROS/TCPROS
    """
    return data[5:].decode("utf-8", "replace") if data[:1] == b"\0" else ""
