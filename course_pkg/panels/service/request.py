"""One call from the panel: the form of the request, and the outcome of the call."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypedDict

from course_pkg.errors import CallCancelled, FieldError
from course_pkg.panels.forms.form import Check, Draft, MessageForm, Row, compact, rows, summary
from course_pkg.ros.explain import known
from course_pkg.types import MessageSchema, Plain, ServiceType, rospy_line, rosservice_line, schema

if TYPE_CHECKING:
    import genpy

DEADLINE = "@deadline"  # No field has this name, because a field's name cannot contain "@".
LONGEST = 3600.0  # The time is in s.

Phase = Literal["idle", "running", "done", "failed", "cancelled"]


class FormState(TypedDict, total=False):
    """The selected service, its node and type, and the fields of the form.

    `problem` is a message about the service or its type; the message is empty if there is no problem.
    """

    service: str
    node: str
    problem: str
    type: str
    md5: str
    request: MessageSchema


class Failure(TypedDict, total=False):
    """The error message of a call, with the course's explanation if there is one."""

    name: str
    words: str
    cause: str
    remedy: str
    taught: str


class Outcome(TypedDict, total=False):
    """The phase of a call.

    After the call, the outcome also contains the time, the duration (ms), and the response or the error.
    """

    phase: Phase
    number: int
    at: str
    ms: float
    rows: list[Row]
    error: Failure


class Entry(TypedDict, total=False):
    """A call in the history: one line of text for the request, and one line for the response.

    A recorded call also has `check` and `outcome`; a page without a kernel shows them.
    """

    phase: Phase
    number: int
    at: str
    ms: float
    draft: Draft
    asked: str
    said: str
    check: Check
    outcome: Outcome


class RequestForm(MessageForm):
    """The form for the request of the service `service`; `kind` is the type of the service."""

    def __init__(self, service: str, kind: ServiceType) -> None:
        super().__init__(
            kind.request,
            lambda values: {
                "shell": rosservice_line(service, kind, values),
                "python": rospy_line(service, kind, values),
            },
        )
        self.service = service
        self.type = kind

    def described(self) -> FormState:
        """Return the form for the page: the fields of the request, with their ranges and comments."""
        return {"type": self.type.name, "md5": self.type.md5, "request": schema(self.type.request)}


def seconds(text: str) -> float:
    """Return the timeout (s) that the student typed.

    Raises FieldError if the text is not a number or the number is out of range.
    """
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value <= LONGEST:
        allowed = f"a number of seconds above 0, at most {LONGEST:g}"
        raise FieldError(DEADLINE, text, allowed, f"{text!r} is not a valid waiting time")
    return value


@dataclass
class Call:
    """One call, from the student's input to the outcome; `timeout` is in s."""

    number: int
    form: RequestForm
    draft: Draft
    values: dict[str, Plain]
    timeout: float
    response: genpy.Message | None = None
    error: BaseException | None = None

    def answered(self, response: genpy.Message, milliseconds: float) -> Outcome:
        """Return the outcome for the page, with the response as rows of a table."""
        self.response, answer = response, self.form.type.response
        values = compact(answer.fields, answer.format(answer.to_values(response)))
        return {**self._outcome("done", milliseconds), "rows": rows(answer.fields, values)}

    def failed(self, error: BaseException, milliseconds: float) -> Outcome:
        """Return the outcome of a failed call for the page: the error message and its explanation."""
        self.error = error
        failure = Failure(name=type(error).__name__, words=str(error))
        if explanation := known(f"{failure['name']}: {failure['words']}"):
            failure |= Failure(cause=explanation.cause, remedy=explanation.remedy, taught=explanation.taught)
        phase: Phase = "cancelled" if isinstance(error, (CallCancelled, KeyboardInterrupt)) else "failed"
        return {**self._outcome(phase, milliseconds), "error": failure}

    def _outcome(self, phase: Phase, milliseconds: float) -> Outcome:
        digits = 1 if milliseconds < 1000 else 0
        at = time.strftime("%H:%M:%S")
        return {"phase": phase, "number": self.number, "at": at, "ms": round(milliseconds, digits)}

    def entry(self, outcome: Outcome) -> Entry:
        """Return the call and its outcome as an entry of the history."""
        said = (
            outcome["error"]["name"]
            if self.error is not None
            else summary(outcome["rows"]) or "an empty response"
        )
        return {
            "phase": outcome["phase"],
            "number": outcome["number"],
            "at": outcome["at"],
            "ms": outcome["ms"],
            "draft": self.draft,
            "asked": summary(rows(self.form.type.request.fields, self.draft)) or "an empty request",
            "said": said,
        }
