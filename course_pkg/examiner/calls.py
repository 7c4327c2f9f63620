"""A student's server, as a check calls it: bounded, and with every failure as a rule that does not hold."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import rospy

from course_pkg.examiner.ledger import Hints, Ledger, hint_for, says
from course_pkg.examiner.plain import Message, Plain, ServiceClass, plain
from course_pkg.examiner.show import command_line, explained, shown

PATIENCE = 3.0  # s for one call, unless a check says otherwise


@dataclass(frozen=True)
class Reply:
    """What one call brought: a response, or the words of the error instead of one."""

    request: Message
    response: Message = None
    error: str = ""
    took: float = 0.0  # s

    @property
    def unanswered(self) -> bool:
        """Whether the call had not come back when its time was over."""
        return self.error.startswith("TimesUp")


class Service:
    """A service of the student's; call it with the fields of a request, get the response."""

    def __init__(
        self, ledger: Ledger, name: str, kind: ServiceClass, label: str, hints: Hints, patience: float
    ) -> None:
        self.name = name
        self.kind = kind
        self.took = 0.0  # s, of the last call
        self._ledger = ledger
        self._label = label  # how rules call it
        self._hints = hints
        self._patience = patience

    def __call__(self, *values: Plain, **fields: Plain) -> Message:
        """Call the service; a call that fails is a rule that does not hold."""
        return self._answered(self._ask([self._request(*values, **fields)])[0])

    def at_once(self, requests: Sequence[Mapping[str, Plain]]) -> list[Reply]:
        """Call with all `requests` at the same time, each on its own thread; return replies in order."""
        replies = self._ask([self._request(**fields) for fields in requests])
        for reply in replies:
            self._answered(reply)
        return replies

    def refused(self, rule: str, *, saying: str = "", hints: Hints = (), **fields: Plain) -> str:
        """Send a request that has to be refused with words that match `saying`; return them."""
        reply = self._ask([self._request(**fields)])[0]
        self._ledger.asked = lambda: command_line(self.name, self.kind, reply.request)
        seen = reply.error or plain(reply.response)
        if not reply.error or reply.unanswered or not says(saying).search(reply.error):
            expected = f"an error that says {saying!r}" if saying else "an error"
            hint = hint_for(hints, seen) or explained(reply.error)
            self._ledger.fails(rule, expected=expected, seen=reply.error or shown(seen), hint=hint)
        self._ledger.passes(rule)
        return reply.error

    def _request(self, *values: Plain, **fields: Plain) -> Message:
        return self.kind._request_class(*values, **fields)

    def _answered(self, reply: Reply) -> Message:
        rule = f"{self._label} answers"
        self.took = reply.took
        self._ledger.asked = lambda: command_line(self.name, self.kind, reply.request)
        if reply.error:
            hint = hint_for(self._hints, reply.error) or explained(reply.error)
            self._ledger.fails(rule, expected="a response", seen=reply.error, hint=hint)
        self._ledger.passes(rule)
        return reply.response

    def _ask(self, requests: Sequence[Message]) -> list[Reply]:
        """Call with all requests at once. A call that hangs is left to its thread: this process ends soon."""
        inboxes = [self._started(request) for request in requests]
        deadline = time.monotonic() + self._patience
        pairs = zip(inboxes, requests, strict=True)
        return [self._reply(inbox, request, deadline) for inbox, request in pairs]

    def _reply(self, inbox: queue.Queue[Reply], request: Message, deadline: float) -> Reply:
        try:
            return inbox.get(timeout=max(deadline - time.monotonic(), 0.01))
        except queue.Empty:
            words = f"TimesUp: no answer within {self._patience:g} s"
            return Reply(request, error=words, took=self._patience)

    def _started(self, request: Message) -> queue.Queue[Reply]:
        inbox: queue.Queue[Reply] = queue.Queue()

        def call() -> None:
            started = time.monotonic()
            response, error = _response(rospy.ServiceProxy(self.name, self.kind), request)
            inbox.put(Reply(request, response, error, time.monotonic() - started))

        threading.Thread(target=call, daemon=True).start()
        return inbox


def _response(proxy: Callable[..., Message], request: Message) -> tuple[Message, str]:
    try:
        return proxy(request), ""
    except Exception as error:  # noqa: BLE001 -- rospy raises whatever its socket did; all of it is a result here
        return None, f"{type(error).__name__}: {error}"
