"""A service of this kernel's node; a cell that defines the service may run again."""

from __future__ import annotations

import logging
import time
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import rospy
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_service import ServiceImpl, convert_return_to_response

from course_pkg.ros.node.handler_output import HandlerOutput, Printed
from course_pkg.ros.node.type_lookup import Message
from course_pkg.ros.protocol.master_api import MasterClient, master_uri

if TYPE_CHECKING:
    from course_pkg.types import ServiceClass

Handler = Callable[[Message], Message]
CAPACITY = 1000  # The list `calls` stores at most this many calls.


@dataclass(frozen=True)
class HandledCall:
    """One call that the server handled.

    `time` is in s since the epoch; `response` or `error` is the result.
    """

    time: float
    request: Message
    response: Message = None
    error: str = ""
    traceback: str = ""


class Service:
    """A service of this kernel. `calls` contains the last 1000 calls.

    `output` is the text that the handler has printed.
    """

    def __init__(self, name: str, cls: ServiceClass, handler: Handler, output: HandlerOutput) -> None:
        self.handler = handler
        self.calls: deque[HandledCall] = deque(maxlen=CAPACITY)
        self._printed = Printed()
        self._output = output
        self._impl = ServiceImpl(name, cls, self._answer, error_handler=self._failed)
        self._active = True

    @property
    def name(self) -> str:
        """The full name of the service."""
        return str(self._impl.resolved_name)

    @property
    def type(self) -> str:
        """The name of the service's type."""
        return str(self._impl.service_class._type)

    @property
    def uri(self) -> str:
        """The address of the service, rosrpc://HOST:PORT."""
        return str(self._impl.uri)

    @property
    def errors(self) -> list[HandledCall]:
        """The stored calls that ended with an error; each has a traceback."""
        return [call for call in self.calls if call.error]

    @property
    def output(self) -> str:
        """The last 65,536 characters that the handler has printed."""
        return self._printed.text

    @property
    def stopped(self) -> bool:
        """Whether this service is no longer served.

        A service is no longer served if it was stopped, or if another service now has the same name.
        """
        return get_service_manager().get_service(self.name) is not self._impl

    def start(self, master: MasterClient) -> None:
        """Register this service; it replaces another service of this process with the same name.

        rospy's own registration would retry for ever if the master has ended.
        """
        manager = get_service_manager()
        with manager.lock:
            before = manager.map.get(self.name)
            manager.map[self.name] = self._impl
        try:
            master.register_service(rospy.get_name(), self.name, self.uri, rospy.get_node_uri())
        except BaseException:
            with manager.lock:
                manager.map.pop(self.name)
                if before is not None:
                    manager.map[self.name] = before
            raise
        if before is not None:
            self._replace(before)

    def stop(self, *, unregister: bool = True) -> None:
        """Stop the service and unregister it; a second call has no effect."""
        self._active = False
        manager = get_service_manager()
        with manager.lock:
            if self.stopped:
                return
            del manager.map[self.name]
        if unregister:
            MasterClient(master_uri()).unregister_service(rospy.get_name(), self.name, self.uri)

    def renew(self, master: MasterClient) -> None:
        """Serve again after a restart of rospy, unless this service was stopped."""
        if self._active:
            cls = self._impl.service_class
            self._impl = ServiceImpl(self.name, cls, self._answer, error_handler=self._failed)
            self.start(master)

    def __enter__(self) -> Service:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.name} of type {self.type}, {'stopped' if self.stopped else 'served'}>"

    def _replace(self, before: ServiceImpl) -> None:
        """Let this service also answer the clients that are still connected to the earlier service.

        The two services have one address. The shutdown() of the earlier service would unregister this
        address, so the earlier service gets an invalid address.
        """
        before.uri = "rosrpc://replaced:0"
        same = before.service_class._md5sum == self._impl.service_class._md5sum
        before.handler = self._answer if same else self._replaced

    def _replaced(self, _request: Message) -> Message:
        raise rospy.ServiceException(f"{self.name} is of type {self.type} now: connect to the service again")

    def _answer(self, request: Message) -> Message:
        """Return the handler's response, or raise an exception that rospy sends as an error message."""
        started = time.time()
        try:
            with self._output.into(self._printed):
                response = convert_return_to_response(self.handler(request), self._impl.response_class)
        except rospy.ServiceException as error:
            self._store(started, request, f"service cannot process request: {error}")
            raise
        except Exception as error:
            self._store(started, request, f"error processing request: {error}")
            raise
        except BaseException as error:
            # After an exception such as SystemExit, rospy sends no response, and the client would wait for
            # ever. After a ServiceException, rospy sends an error message.
            message = f"handler ended with {type(error).__name__}: {error}"
            self._store(started, request, f"service cannot process request: {message}")
            raise rospy.ServiceException(message) from error
        self.calls.append(HandledCall(started, request, response))
        return response

    def _store(self, started: float, request: Message, message: str) -> None:
        self.calls.append(HandledCall(started, request, None, message, traceback.format_exc()))

    def _failed(self, error: Exception, *_: object) -> None:
        """Log an error that rospy reports; an error that the handler raised is already stored."""
        logging.getLogger("rospy.course").error("%s: %s", self.name, error, exc_info=error)
        last = self.calls[-1] if self.calls else None
        if last is not None and last.response is not None:
            # rospy could not serialise the response, because a field has an invalid value.
            message, trace = f"error processing request: {error}", "".join(traceback.format_exception(error))
            self.calls[-1] = HandledCall(last.time, last.request, None, message, trace)
