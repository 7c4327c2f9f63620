"""10.5: the till that the student's shop calls."""

from __future__ import annotations

import threading

from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop_in_kernel import TRIGGER, CheckedShelf
from course_pkg.checking import CheckContext
from course_pkg.checking.peers.scripted_server import Act
from course_pkg.checking.plain_values import Message, Value
from course_pkg.errors import GraphError
from course_pkg.ros.node.proxy import BoundedProxy

MEETING = 3.0  # A call to the till waits up to this time in s for other calls.
CALL_BACK = 2.0  # After this time in s, the till continues without a response from the shop.


class Till:
    """A till that charges amounts; while the till handles its first call, it calls a service of the shop.

    If many clients call the till at the same time, its first call waits for the other calls; `crowd` is the
    total number of calls.
    """

    def __init__(self, context: CheckContext, left: str, shelf: CheckedShelf) -> None:
        # `acts` contains the results of the next calls; None means that the till charges the amount.
        self.acts: list[Act | None] = []
        self.charged: list[int] = []  # The amounts are in cents.
        self.ids: list[str] = []
        # `answers` contains the shop's responses to calls of /left; "" means that there was no response yet.
        self.answers: list[str] = []
        # `on_shelf` contains the number of things on the shelf during each call.
        self.on_shelf: list[Value] = []
        self._shelf = shelf
        # The receipts have the numbers `offset` + 1, `offset` + 2 and so on.
        self.offset = context.random.integer(1000, 9000)
        self._left, self._kind = left, context.service_class(TRIGGER)
        self._inside, self._meets = 0, False
        self.crowd = context.random.integer(4, 6)
        self.together = 0  # `together` is the maximum number of simultaneous calls.
        self._changed = threading.Condition()

    def await_crowd(self) -> None:
        """Let the next calls wait until `crowd` calls have arrived, but for at most `MEETING` s."""
        self._meets = True

    def __call__(self, request: Message) -> Act:
        """Handle a request to the scripted server."""
        with self._changed:
            self._inside += 1
            self.together = max(self.together, self._inside)
            self._changed.notify_all()
            if self._meets:
                self._changed.wait_for(lambda: self.together >= self.crowd, MEETING)
                self._meets = False
        try:
            return self._act(request)
        finally:
            with self._changed:
                self._inside -= 1

    def _act(self, request: Message) -> Act:
        with self._changed:
            calls_back = not self.answers
            if calls_back:
                self.answers.append("")
            act = self.acts.pop(0) if self.acts else None
            self.ids.append(request.request_id)
            self.on_shelf.append(self._shelf.things)
            if act is None:
                self.charged.append(request.cents)
            receipt = self.offset + len(self.charged)
        if calls_back:
            self.answers[0] = self._call_back()
        return {"receipt": receipt} if act is None else act

    def _call_back(self) -> str:
        try:
            return str(BoundedProxy(self._left, self._kind, timeout=CALL_BACK).call().message)
        except (GraphError, OSError) as error:
            return f"{type(error).__name__}"
