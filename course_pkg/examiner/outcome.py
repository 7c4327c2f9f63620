"""What came of running something of the student's in the kernel."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from course_pkg.examiner.ledger import Hints, Ledger, hint_for, says
from course_pkg.examiner.plain import Plain
from course_pkg.examiner.show import explained, shown


class Outcome:
    """How one call of a student's function ended: with a value or with an error, never both."""

    def __init__(self, ledger: Ledger, label: str, answer: Mapping[str, Any], hints: Hints) -> None:
        self.printed = str(answer.get("printed", ""))
        self.took = float(answer.get("took", 0.0))  # s
        self._value = answer.get("value")
        self._error: Mapping[str, Any] | None = answer.get("error")
        self._ledger = ledger
        self._label = label  # of the call, as a rule words it: "measure()"
        self._hints = hints

    @property
    def error(self) -> str:
        """The error as ROS and Python word it, `TypeName: message`; an empty text when there was none."""
        if self._error is None:
            return ""
        return f"{self._error.get('type')}: {self._error.get('text')}"

    @property
    def value(self) -> Plain:
        """What the function returned, as plain data. That it returned at all is a rule."""
        rule = f"{self._label} returns"
        if self.error:
            hint = hint_for(self._hints, self.error) or self._explained()
            self._ledger.fails(rule, expected="a value", seen=self.error, hint=hint)
        self._ledger.passes(rule)
        return self._value

    def raised(self, rule: str, kind: str, *, saying: str = "", hints: Hints = ()) -> str:
        """Hold to `rule` that an error of the type `kind` (or derived from it) came; return its words."""
        seen = self.error or f"the value {shown(self._value)}"
        if not self._is(kind) or not says(saying).search(self.error):
            expected = f"{kind} that says {saying!r}" if saying else kind
            hint = hint_for(hints, self.error or self._value) or hint_for(self._hints, self.error)
            self._ledger.fails(rule, expected=expected, seen=seen, hint=hint or self._explained())
        self._ledger.passes(rule)
        return self.error

    def _is(self, kind: str) -> bool:
        error = self._error or {}
        return kind == error.get("type") or kind in error.get("bases", [])

    def _explained(self) -> str:
        if self.error.startswith("TimesUp"):
            return f"{self._label} waits for something that does not happen: give the wait a limit."
        where = (self._error or {}).get("line")
        return explained(self.error) or (f"The error came from line {where} of the cell." if where else "")


class Finished:
    """How a command of the student's ended."""

    def __init__(self, answer: Mapping[str, Any]) -> None:
        self.status: int | None = answer.get("status")  # None: broken off
        self.out = str(answer.get("out", ""))
        self.err = str(answer.get("err", ""))
        self.took = float(answer.get("took", 0.0))  # s
