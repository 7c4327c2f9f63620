"""A service of this kernel's node, which a cell may define again and again."""

from __future__ import annotations

import logging
import time
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import rospy
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_service import ServiceImpl, convert_return_to_response

from course_pkg.graph.master import master_uri
from course_pkg.graph.output import HandlerOutput, Printed
from course_pkg.graph.rpc import MasterClient

Handler = Callable[[Any], Any]
REMEMBERED = 1000  # calls


@dataclass(frozen=True)
class ServedCall:
    """One call as its server saw it: `time` in s since the epoch, a response or the words of the error."""

    time: float
    request: Any
    response: Any = None
    error: str = ""
    traceback: str = ""


class Served:
    """A service of this kernel. `calls` remembers the last 1000; `output` is what the handler printed."""

    def __init__(self, name: str, cls: Any, handler: Handler, output: HandlerOutput) -> None:  # noqa: ANN401
        self.handler = handler
        self.calls: deque[ServedCall] = deque(maxlen=REMEMBERED)
        self._printed = Printed()
        self._output = output
        self._impl = ServiceImpl(name, cls, self._answer, error_handler=self._failed)
        self._wanted = True

    @property
    def name(self) -> str:
        """The full name of the service."""
        return str(self._impl.resolved_name)

    @property
    def type(self) -> str:
        """The name of its type."""
        return str(self._impl.service_class._type)

    @property
    def uri(self) -> str:
        """Where it is served, rosrpc://HOST:PORT."""
        return str(self._impl.uri)

    @property
    def errors(self) -> list[ServedCall]:
        """The remembered calls that ended in an error, with tracebacks."""
        return [call for call in self.calls if call.error]

    @property
    def output(self) -> str:
        """The end of what the handler has printed."""
        return self._printed.text

    @property
    def stopped(self) -> bool:
        """Whether something else, or nothing, is served by this name now."""
        return get_service_manager().get_service(self.name) is not self._impl

    def start(self, master: MasterClient) -> None:
        """Take the name over from whoever in this process has it, and register it.

        Registered from here and not by rospy, whose attempt has no end when the master is gone.
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
            self._relieve(before)

    def stop(self, *, withdraw: bool = True) -> None:
        """End the service and withdraw it from the master; a second stop changes nothing."""
        self._wanted = False
        manager = get_service_manager()
        with manager.lock:
            if self.stopped:
                return
            del manager.map[self.name]
        if withdraw:
            MasterClient(master_uri()).unregister_service(rospy.get_name(), self.name, self.uri)

    def renew(self, master: MasterClient) -> None:
        """Serve again in a rospy that has begun anew, if nobody has stopped it."""
        if self._wanted:
            cls = self._impl.service_class
            self._impl = ServiceImpl(self.name, cls, self._answer, error_handler=self._failed)
            self.start(master)

    def __enter__(self) -> Served:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.name} of type {self.type}, {'stopped' if self.stopped else 'served'}>"

    def _relieve(self, before: ServiceImpl) -> None:
        """Have connections that clients keep to the predecessor answered as this service answers.

        Its address is spoilt: its own shutdown() would withdraw whatever is registered there, which is this
        service.
        """
        before.uri = "rosrpc://replaced:0"
        same = before.service_class._md5sum == self._impl.service_class._md5sum
        before.handler = self._answer if same else self._replaced

    def _replaced(self, _request: Any) -> Any:  # noqa: ANN401
        raise rospy.ServiceException(f"{self.name} is of type {self.type} now: connect to it again")

    def _answer(self, request: Any) -> Any:  # noqa: ANN401
        """Return the handler's response, or raise what rospy turns into the words of an error."""
        started = time.time()
        try:
            with self._output.into(self._printed):
                response = convert_return_to_response(self.handler(request), self._impl.response_class)
        except rospy.ServiceException as error:
            self._remember(started, request, f"service cannot process request: {error}")
            raise
        except Exception as error:
            self._remember(started, request, f"error processing request: {error}")
            raise
        except BaseException as error:
            # rospy answers to none of these, and the client would wait for ever.
            words = f"handler ended with {type(error).__name__}: {error}"
            self._remember(started, request, f"service cannot process request: {words}")
            raise rospy.ServiceException(words) from error
        self.calls.append(ServedCall(started, request, response))
        return response

    def _remember(self, started: float, request: Any, words: str) -> None:  # noqa: ANN401
        self.calls.append(ServedCall(started, request, None, words, traceback.format_exc()))

    def _failed(self, error: Exception, *_: Any) -> None:  # noqa: ANN401
        """Take note of an error as rospy reports it; what the handler raised is remembered already."""
        logging.getLogger("rospy.course").error("%s: %s", self.name, error, exc_info=error)
        last = self.calls[-1] if self.calls else None
        if last is not None and last.response is not None:
            # The response was of the right type and could not be packed: a field holds a wrong value.
            words, trace = f"error processing request: {error}", "".join(traceback.format_exception(error))
            self.calls[-1] = ServedCall(last.time, last.request, None, words, trace)
