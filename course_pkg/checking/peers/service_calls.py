"""A check's calls to a student's server, with a time limit, and with assertions about each response."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import rospy

from course_pkg.checking.assertions import Hints, Results, hint_for, matches
from course_pkg.checking.common_hints import HANDLER_RAISED
from course_pkg.checking.formatting import command_line, explained, shown
from course_pkg.checking.plain_values import Message, ServiceClass, Value, plain
from course_pkg.waiting import Deadline

HANDLERS_ERROR = matches("error processing request")
LONGEST = 2000  # A traceback in a report has at most this number of characters.
TIMEOUT = 3.0  # A call has this time limit in s, unless a check sets another limit.


@dataclass(frozen=True)
class Reply:
    """The result of one call: a response, or the text of an error."""

    request: Message
    response: Message = None
    error: str = ""
    took: float = 0.0  # The call took this time in s.

    @property
    def unanswered(self) -> bool:
        """Return whether the call reached its time limit."""
        return self.error.startswith("TimesUp")


class Service:
    """A service of the student: call it with the fields of a request to get the response."""

    def __init__(
        self,
        results: Results,
        name: str,
        kind: ServiceClass,
        label: str,
        hints: Hints,
        timeout: float,
        traceback: Callable[[], str],
    ) -> None:
        self.name = name
        self.kind = kind
        self.took = 0.0  # The last call took this time in s.
        self._results = results
        self._label = label  # Assertions show this text for the service.
        self._hints = hints
        self._timeout = timeout
        # This function asks the kernel for the traceback of the handler's last exception.
        self._traceback = traceback

    def __call__(self, *values: Value, **fields: Value) -> Message:
        """Call the service once, assert that it responds, and return the response."""
        return self._answered(self._call([self._request(*values, **fields)])[0])

    def at_once(self, requests: Sequence[Mapping[str, Value]]) -> list[Reply]:
        """Make one call for each request, all at the same time; return the replies in the same order.

        Asserts that the service responds to each request.
        """
        replies = self.replies(requests)
        for reply in replies:
            self._answered(reply)
        return replies

    def replies(self, requests: Sequence[Mapping[str, Value]]) -> list[Reply]:
        """Make the same calls as at_once(), but do not assert that the service responds."""
        return self._call([self._request(**fields) for fields in requests])

    def refused(
        self, assertion: str, *, saying: str | tuple[str, str] = "", hints: Hints = (), **fields: Value
    ) -> str:
        """Assert that the service refuses a request with an error message that matches the pattern `saying`.

        If `saying` is a pair, its first item is the pattern, and its second item is a text such as "contains
        -1". A report shows this text instead of the pattern. Returns the error message.
        """
        reply = self._call([self._request(**fields)])[0]
        self._results.asked = lambda: command_line(self.name, self.kind, reply.request)
        actual = reply.error or plain(reply.response)
        pattern, described = saying if isinstance(saying, tuple) else (saying, f"matches {saying!r}")
        if not reply.error or reply.unanswered or not matches(pattern).search(reply.error):
            expected = f"an error message that {described}" if pattern else "an error"
            hint = hint_for(hints, actual) or self._explained(reply.error)
            seen = self._with_traceback(reply.error) if reply.error else shown(actual)
            self._results.fails(assertion, expected=expected, actual=seen, hint=hint)
        self._results.passes(assertion)
        return reply.error

    def _request(self, *values: Value, **fields: Value) -> Message:
        return self.kind._request_class(*values, **fields)

    def _answered(self, reply: Reply) -> Message:
        assertion = f"{self._label} answers"
        self.took = reply.took
        self._results.asked = lambda: command_line(self.name, self.kind, reply.request)
        if reply.error:
            hint = hint_for(self._hints, reply.error) or self._explained(reply.error)
            seen = self._with_traceback(reply.error)
            self._results.fails(assertion, expected="a response", actual=seen, hint=hint)
        self._results.passes(assertion)
        return reply.response

    def _explained(self, error: str) -> str:
        return hint_for(HANDLER_RAISED, error) or explained(error)

    def _with_traceback(self, error: str) -> str:
        """Return the error message and the traceback of the handler."""
        if not HANDLERS_ERROR.search(error):
            return error
        return f"{error}\n{self._traceback()[:LONGEST]}".strip()

    def _call(self, requests: Sequence[Message]) -> list[Reply]:
        """Make calls with all requests at the same time.

        If a call gets no response, its thread runs until this process ends.
        """
        inboxes = [self._started(request) for request in requests]
        deadline = Deadline(self._timeout)
        pairs = zip(inboxes, requests, strict=True)
        return [self._reply(inbox, request, deadline) for inbox, request in pairs]

    def _reply(self, inbox: queue.Queue[Reply], request: Message, deadline: Deadline) -> Reply:
        try:
            return inbox.get(timeout=max(deadline.left, 0.01))
        except queue.Empty:
            error = f"TimesUp: no response within {self._timeout:g} s"
            return Reply(request, error=error, took=self._timeout)

    def _started(self, request: Message) -> queue.Queue[Reply]:
        inbox: queue.Queue[Reply] = queue.Queue()

        def call() -> None:
            started = time.monotonic()
            response, error = response_of(rospy.ServiceProxy(self.name, self.kind), request)
            inbox.put(Reply(request, response, error, time.monotonic() - started))

        threading.Thread(target=call, daemon=True).start()
        return inbox


def response_of(proxy: Callable[..., Message], request: Message) -> tuple[Message, str]:
    """Call a service; return (the response, an error message)."""
    try:
        return proxy(request), ""
    except Exception as error:  # noqa: BLE001 -- rospy can raise any error of its socket; each is a result
        return None, f"{type(error).__name__}: {error}"
