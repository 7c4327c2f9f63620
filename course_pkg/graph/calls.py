"""Calling a service in bounded time.

rospy's ServiceProxy has no limit, and its sockets take none: it sets them to block again. So the transport is
made here, where a watchdog or another thread can shut its socket down in whatever phase the call is.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import rospy
from rospy.core import parse_rosrpc_uri
from rospy.exceptions import TransportException, TransportInitError
from rospy.impl import tcpros_base
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.msg import args_kwds_to_message

from course_pkg.errors import CallCancelled, CallTimeout, GraphError, MasterSilent, MasterUnreachable
from course_pkg.graph.master import master_uri
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.service_taps import RecordedCall, RecordedLookup, service_transport
from course_pkg.graph.types import service_class
from course_pkg.graph.watchdog import Watchdog

KEPT = "_use_tcp_keepalive"  # where rospy keeps that parameter, None as long as it has not asked


class BoundedProxy(rospy.ServiceProxy):
    """A ServiceProxy whose calls end: with a response, with rospy's own error, or with the deadline.

    Threads may share it. A persistent one connects anew when its server has gone.
    """

    def __init__(
        self,
        name: str,
        kind: Any,  # noqa: ANN401 -- a generated class, a ServiceType or a name
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
        self._under_way: set[_Call] = set()
        self._kept: TCPROSTransport | None = None
        self._turn = threading.Lock()  # of a persistent connection, which carries one call at a time

    def call(self, *args: Any, timeout: float | None = None, **fields: Any) -> Any:  # noqa: ANN401
        """Return the response to a request given by position, by field, or whole.

        Raises CallTimeout after `timeout` s, CallCancelled after cancel(), and what rospy raises.
        """
        with RecordedCall(self.resolved_name):
            return self._called(args, fields, self.timeout if timeout is None else timeout)

    def cancel(self) -> None:
        """End the calls that are under way; each raises CallCancelled where it was made."""
        for call in list(self._under_way):
            call.watches.append(self._watchdog.arm(time.monotonic(), call.cancel))
            if call.over:  # meanwhile, and its own disarming may have missed this watch
                self._disarm(call)

    def close(self) -> None:
        """Cancel what is under way and close the connections."""
        self.cancel()
        kept, self._kept = self._kept, None
        if kept is not None:
            kept.close()
        self._master.close()

    def _called(self, args: Sequence[Any], fields: Mapping[str, Any], timeout: float) -> Any:  # noqa: ANN401
        request = args_kwds_to_message(self.request_class, args, fields)
        if request._type != self.request_class._type:
            words = "request object type [%s] does not match service type [%s]"  # rospy's
            raise TypeError(words % (request.__class__, self.request_class))
        call = _Call(self.resolved_name, timeout)
        self._under_way.add(call)
        call.watches.append(self._watchdog.arm(call.deadline, call.expire))
        try:
            return self._persistently(call, request) if self.persistent else self._once(call, request)
        except (rospy.ServiceException, TransportException, OSError, AttributeError):
            # A socket that was shut down under rospy's hands shows as any of these.
            if call.verdict is None:
                raise
            raise call.verdict from None  # what rospy made of the socket closed under it says nothing
        finally:
            call.over = True
            self._under_way.discard(call)
            self._disarm(call)

    def _disarm(self, call: _Call) -> None:
        for watch in list(call.watches):
            self._watchdog.disarm(watch)

    def _once(self, call: _Call, request: Any) -> Any:  # noqa: ANN401
        transport = self._connected(call)
        try:
            return self._exchanged(transport, request)
        finally:
            transport.close()

    def _persistently(self, call: _Call, request: Any) -> Any:  # noqa: ANN401
        if not self._turn.acquire(timeout=call.rest()):
            raise call.too_late("another call over this persistent proxy is still waiting for its answer")
        try:
            transport, self._kept = self._kept, None
            if transport is not None and _hung_up(transport):
                transport.close()
                transport = None
            transport = transport or self._connected(call)
            call.transport = transport
            try:
                response = self._exchanged(transport, request)
            except rospy.ServiceException as error:
                if error.__cause__ is None and call.verdict is None:
                    self._kept = transport  # the server answered, with an error
                else:
                    transport.close()
                raise
            except BaseException:
                transport.close()
                raise
            self._kept = transport
            return response
        finally:
            self._turn.release()

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
        if call.verdict is not None:
            transport.close()
            raise call.verdict
        return transport

    def _looked_up(self, call: _Call) -> str:
        master = self._current_master()
        try:
            with RecordedLookup():
                uri = master.lookup_service(self.resolved_name, timeout=call.rest())
        except MasterUnreachable as error:
            raise rospy.ServiceException("unable to contact master") from error
        except MasterSilent as error:
            raise call.too_late(f"the master at {master.uri} does not answer") from error
        if call.verdict is not None:
            raise call.verdict
        if uri is None:
            raise rospy.ServiceException(f"service [{self.resolved_name}] unavailable")
        self.uri = uri
        return uri

    def _exchanged(self, transport: TCPROSTransport, request: Any) -> Any:  # noqa: ANN401
        """Send and receive, in the words of rospy.ServiceProxy.call."""
        self.seq += 1
        transport.send_message(request, self.seq)
        try:
            responses = transport.receive_once()
        except TransportException as error:
            if rospy.core.is_shutdown():
                words = "node shutdown interrupted service call"
                raise rospy.exceptions.ROSInterruptException(words) from error
            raise rospy.ServiceException(f"transport error completing service call: {error}") from error
        if not responses:
            raise rospy.ServiceException(f"service [{self.resolved_name}] returned no response")
        return responses[0]

    def _current_master(self) -> MasterClient:
        if self._master.uri != master_uri():
            self._master = MasterClient(master_uri())
        return self._master


class _Call:
    """One call under way: its deadline, its transport once there is one, and why it was broken off."""

    def __init__(self, name: str, timeout: float) -> None:
        self.deadline = time.monotonic() + timeout
        self.over = False
        self.watches: list[int] = []
        self.transport: TCPROSTransport | None = None
        self.verdict: GraphError | None = None
        self._name = name
        self._timeout = timeout

    def rest(self) -> float:
        """Return how many s are left, and never quite nothing."""
        return max(self.deadline - time.monotonic(), 0.001)

    def too_late(self, why: str) -> CallTimeout:
        """Return the error for a deadline that has passed, with a reason."""
        return CallTimeout(f"service [{self._name}]: no answer within {self._timeout:g} s; {why}.")

    def expire(self) -> None:
        """Break the call off because its time is up."""
        self._break_off(self.too_late(self._waiting_for()))

    def cancel(self) -> None:
        """Break the call off because its caller no longer wants it."""
        words = "the call was cancelled; the server may still work on it."
        self._break_off(CallCancelled(f"service [{self._name}]: {words}"))

    def _waiting_for(self) -> str:
        if self.transport is None or not self.transport.socket:
            return "it was not even reached"
        if self.transport.md5sum is None:
            return "the server takes connections and does not speak: stopped, or busy with another one"
        return "its handler is still working, waits for something itself, or ended without an answer"

    def _break_off(self, verdict: GraphError) -> None:
        if self.over:
            return
        self.verdict = self.verdict or verdict
        sock = self.transport.socket if self.transport else None
        if sock is not None:
            with suppress(OSError):  # not connected yet: the watchdog comes again
                sock.shutdown(socket.SHUT_RDWR)


def settle_keepalive(master: MasterClient) -> None:
    """Ask the master what rospy would ask it at its first connection, without a limit."""
    if getattr(tcpros_base, KEPT, True) is None:
        setattr(tcpros_base, KEPT, master.get_param("/tcp_keepalive", True))


def _hung_up(transport: TCPROSTransport) -> bool:
    """Say whether the other end of an idle connection is gone; it has nothing to say but that."""
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
