"""The results of student code that a check runs: a function in the kernel, or a command."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from typing import overload

from course_pkg.checking.assertions import Hints, Results, hint_for, matches
from course_pkg.checking.formatting import explained, shown
from course_pkg.checking.plain_values import Item, of_kind
from course_pkg.ros.protocol.json_channel import Json


class Result:
    """The result of one call of a student's function: a value or an error."""

    def __init__(
        self, results: Results, label: str, reply: Mapping[str, Json], took: float, hints: Hints
    ) -> None:
        self.printed = str(reply.get("printed", ""))
        self.took = took  # The check runner measured this duration in s.
        self._value = reply.get("value")
        error = reply.get("error")
        self._error = error if isinstance(error, dict) else None
        self._results = results
        self._label = label  # The titles of assertions contain this text, for example "measure()".
        self._hints = hints

    @property
    def error(self) -> str:
        """The error in the form `TypeName: message`, or "" if there was no error."""
        if self._error is None:
            return ""
        return f"{self._error.get('type')}: {self._error.get('text')}"

    @property
    def value(self) -> Json:
        """The return value as plain data, or None after an error."""
        return self._value

    @overload
    def returned(self) -> Json: ...
    @overload
    def returned(self, kind: type[Item]) -> Item: ...
    def returned(self, kind: type[Item] | None = None) -> Json | Item:
        """Assert that the function returned without an error, and return its value as plain data.

        If the function is the check's own function, pass the expected class as `kind`. In this case,
        CheckError is raised for a value of another class.
        """
        assertion = f"{self._label} returns"
        if self.error:
            hint = hint_for(self._hints, self.error) or self._explained()
            self._results.fails(assertion, expected="a value", actual=self.error, hint=hint)
        self._results.passes(assertion)
        return self._value if kind is None else of_kind(kind, self._value, self._label)

    def raised(self, assertion: str, kind: str, *, saying: str = "", hints: Hints = ()) -> str:
        """Assert that the call raised an error of the class `kind` or a subclass; return the error's message.

        `saying` is a pattern that the error's message has to match.
        """
        actual = self.error or f"the value {shown(self._value)}"
        if not self._is(kind) or not matches(saying).search(self.error):
            expected = f"{kind} with a message that matches {saying!r}" if saying else kind
            hint = hint_for(hints, self.error or self._value) or hint_for(self._hints, self.error)
            self._results.fails(assertion, expected=expected, actual=actual, hint=hint or self._explained())
        self._results.passes(assertion)
        return self.error

    def _is(self, kind: str) -> bool:
        error = self._error or {}
        bases = error.get("bases")
        return kind == error.get("type") or (isinstance(bases, list) and kind in bases)

    def _explained(self) -> str:
        if self.error.startswith("TimesUp"):
            return f"{self._label} waits for something that does not happen. Add a time limit to the wait."
        where = (self._error or {}).get("line")
        return explained(self.error) or (f"The error occurred in line {where} of the cell." if where else "")


class Finished:
    """The result of a student's command."""

    def __init__(self, reply: Mapping[str, Json]) -> None:
        status, took = reply.get("status"), reply.get("took")
        # `status` is None if the command was still running.
        self.status = status if isinstance(status, int) else None
        self.out = str(reply.get("out", ""))
        self.err = str(reply.get("err", ""))
        self.took = took if isinstance(took, float) else 0.0  # The command took this time in s.
        # `ago` is the time in s between the end of the command and this reply; only stop() sends it.
        ago = reply.get("ago")
        self.ended = time.monotonic() - (ago if isinstance(ago, float) else 0.0)  # s, time.monotonic()
        # `ran` is the CPU time in s of a command that was stopped at its time limit. `queued` is the time in
        # s for which the command waited for a CPU.
        ran, queued = reply.get("ran"), reply.get("queued")
        self.ran = ran if isinstance(ran, float) else 0.0
        # If the kernel did not send a waiting time, the waiting time is infinite.
        self.queued = queued if isinstance(queued, float) else math.inf
