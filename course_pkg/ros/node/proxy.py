"""Call a service with a time limit.

rospy's ServiceProxy has no time limit, and its sockets block. This module therefore creates the transport
itself. To end a call at any time, a watchdog or another thread shuts down the transport's socket.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress

import rospy
from rospy.core import parse_rosrpc_uri
from rospy.exceptions import TransportException, TransportInitError
from rospy.impl import tcpros_base
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.msg import args_kwds_to_message

from course_pkg.errors import CallCancelled, CallTimeout, GraphError, MasterSilent, MasterUnreachable
from course_pkg.ros.node.type_lookup import Message, ServiceKind, service_class
from course_pkg.ros.node.watchdog import Watchdog
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.trace.service_hooks import RecordedCall, RecordedLookup, service_transport

# This attribute of rospy stores the parameter /tcp_keepalive. It is None until rospy reads the parameter.
KEEPALIVE = "_use_tcp_keepalive"


class BoundedProxy(rospy.ServiceProxy):
    """A ServiceProxy with a time limit.

    Each call ends at its deadline or earlier, with a response or with an error.

    Several threads may use one proxy. After a restart of the server, a persistent proxy connects again.
    """

    def __init__(
        self,
        name: str,
        kind: ServiceKind,
        *,
        persistent: bool = False,
        headers: dict[str, str] | None = None,
        timeout: float = 5.0,
        watchdog: Watchdog | None = None,
    ) -> None:
        super().__init__(name, service_class(kind), persistent, dict(headers or {}))  # type: ignore[no-untyped-call]
        self.timeout = timeout
        self._watchdog = watchdog or Watchdog()
        self._master = MasterClient(master_uri())
        self._running: set[_Call] = set()
        self._connection: TCPROSTransport | None = None
        self._lock = threading.Lock()  # A persistent connection can transmit only one call at a time.

    def call(self, *args: object, timeout: float | None = None, **fields: object) -> Message:
        """Call the service and return the response.

        Pass the request's fields by position or by name, or pass one request object.

        Raises CallTimeout after `timeout` s, CallCancelled after cancel(), and the errors of rospy.
        """
        with RecordedCall(self.resolved_name):
            return self._call(args, fields, self.timeout if timeout is None else timeout)

    def cancel(self) -> None:
        """End all running calls; each call raises CallCancelled in the thread that made it."""
        for call in list(self._running):
            call.actions.append(self._watchdog.arm(time.monotonic(), call.cancel))
            # The call may have ended before arm() added this action to the watchdog. In this case, the next
            # lines remove the action.
            if call.over:
                self._disarm(call)

    def close(self) -> None:
        """Cancel all running calls and close the connections."""
        self.cancel()
        kept, self._connection = self._connection, None
        if kept is not None:
            kept.close()
        self._master.close()

    def _call(self, args: Sequence[object], fields: Mapping[str, object], timeout: float) -> Message:
        request = args_kwds_to_message(self.request_class, args, fields)
        if request._type != self.request_class._type:
            # The text is a copy of rospy's error message.
            text = "request object type [%s] does not match service type [%s]"
            raise TypeError(text % (request.__class__, self.request_class))
        call = _Call(self.resolved_name, timeout)
        self._running.add(call)
        call.actions.append(self._watchdog.arm(call.deadline, call.expire))
        try:
            return self._persistently(call, request) if self.persistent else self._once(call, request)
        except (rospy.ServiceException, TransportException, OSError, AttributeError):
            # While rospy uses the socket, another thread may shut the socket down. rospy then raises one of
            # these errors.
            if call.error is None:
                raise
            # rospy's error only says that the socket is closed; `call.error` contains the reason.
            raise call.error from None
        finally:
            call.over = True
            self._running.discard(call)
            self._disarm(call)

    def _disarm(self, call: _Call) -> None:
        for action in list(call.actions):
            self._watchdog.disarm(action)

    def _once(self, call: _Call, request: Message) -> Message:
        transport = self._connected(call)
        try:
            return self._exchanged(transport, request)
        finally:
            transport.close()

    def _persistently(self, call: _Call, request: Message) -> Message:
        if not self._lock.acquire(timeout=call.left()):
            raise call.too_late("another call through this persistent proxy still waits for its response")
        try:
            transport, self._connection = self._connection, None
            if transport is not None and _hung_up(transport):
                transport.close()
                transport = None
            transport = transport or self._connected(call)
            call.transport = transport
            try:
                response = self._exchanged(transport, request)
            except rospy.ServiceException as error:
                if error.__cause__ is None and call.error is None:
                    # The server has sent the error message, so the connection still works and can be used
                    # again.
                    self._connection = transport
                else:
                    transport.close()
                raise
            except BaseException:
                transport.close()
                raise
            self._connection = transport
            return response
        finally:
            self._lock.release()

    def _connected(self, call: _Call) -> TCPROSTransport:
        uri = self._looked_up(call)
        host, port = parse_rosrpc_uri(uri)
        settle_keepalive(self._current_master())
        transport = service_transport(self.protocol, self.resolved_name)
        call.transport = transport
        connected = False
        try:
            transport.connect(host, port, uri)
            connected = True
        except TransportInitError as error:
            raise rospy.ServiceException(f"unable to connect to service: {error}") from error
        finally:
            if not connected:
                transport.close()
        if call.error is not None:
            transport.close()
            raise call.error
        return transport

    def _looked_up(self, call: _Call) -> str:
        master = self._current_master()
        try:
            with RecordedLookup():
                uri = master.lookup_service(self.resolved_name, timeout=call.left())
        except MasterUnreachable as error:
            raise rospy.ServiceException("unable to contact master") from error
        except MasterSilent as error:
            raise call.too_late(f"the master at {master.uri} does not answer") from error
        if call.error is not None:
            raise call.error
        if uri is None:
            raise rospy.ServiceException(f"service [{self.resolved_name}] unavailable")
        self.uri = uri
        return uri

    def _exchanged(self, transport: TCPROSTransport, request: Message) -> Message:
        """Send the request and return the response; raises the same errors as rospy.ServiceProxy.call."""
        self.seq += 1
        transport.send_message(request, self.seq)
        try:
            responses = transport.receive_once()
        except TransportException as error:
            if rospy.core.is_shutdown():
                text = "node shutdown interrupted service call"
                raise rospy.exceptions.ROSInterruptException(text) from error
            raise rospy.ServiceException(f"transport error completing service call: {error}") from error
        if not responses:
            raise rospy.ServiceException(f"service [{self.resolved_name}] returned no response")
        return responses[0]

    def _current_master(self) -> MasterClient:
        if self._master.uri != master_uri():
            self._master = MasterClient(master_uri())
        return self._master


class _Call:
    """One running call: its deadline, its transport (None at first), and the error that ended it."""

    def __init__(self, name: str, timeout: float) -> None:
        self.deadline = time.monotonic() + timeout
        self.over = False
        self.actions: list[int] = []
        self.transport: TCPROSTransport | None = None
        self.error: GraphError | None = None
        self._name = name
        self._timeout = timeout

    def left(self) -> float:
        """Return the time until the deadline in s, at least 0.001."""
        return max(self.deadline - time.monotonic(), 0.001)

    def too_late(self, why: str) -> CallTimeout:
        """Return the CallTimeout for this call; its message contains the reason `why`."""
        return CallTimeout(f"service [{self._name}]: no answer within {self._timeout:g} s; {why}.")

    def expire(self) -> None:
        """End the call because its deadline has passed."""
        self._break_off(self.too_late(self._waiting_for()))

    def cancel(self) -> None:
        """End the call because the caller has cancelled it."""
        text = "the call was cancelled; the server may still work on it."
        self._break_off(CallCancelled(f"service [{self._name}]: {text}"))

    def _waiting_for(self) -> str:
        if self.transport is None or not self.transport.socket:
            return "the server was not reached"
        if self.transport.md5sum is None:
            return (
                "the server accepts connections, but sends nothing: it is paused or busy with another "
                "connection"
            )
        return "its handler is still working, is waiting for something, or has ended without an answer"

    def _break_off(self, error: GraphError) -> None:
        if self.over:
            return
        self.error = self.error or error
        sock = self.transport.socket if self.transport else None
        if sock is not None:
            # shutdown() fails if the socket is not connected yet; the watchdog then runs this method again.
            with suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)


def settle_keepalive(master: MasterClient) -> None:
    """Read the parameter /tcp_keepalive with a time limit; rospy's own code has no time limit."""
    if getattr(tcpros_base, KEEPALIVE, True) is None:
        setattr(tcpros_base, KEEPALIVE, master.get_param("/tcp_keepalive", True))


def _hung_up(transport: TCPROSTransport) -> bool:
    """Return whether the server has closed an idle connection.

    On an open idle connection, recv() finds no data and raises BlockingIOError.
    """
    sock = transport.socket
    if sock is None:
        return True
    try:
        sock.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True
