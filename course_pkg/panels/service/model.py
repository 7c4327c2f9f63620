"""The state of a service panel; this module does not need ROS.

The argument `connect` of ServiceModel is a function that returns a Caller for one service.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Protocol, TypedDict

from course_pkg.errors import CallCancelled, CallInProgress, CourseError, FieldError, NoServiceSelected
from course_pkg.panels.forms.form import Check, Draft, Values, correction
from course_pkg.panels.service.request import (
    DEADLINE,
    Call,
    Entry,
    FormState,
    Outcome,
    RequestForm,
    seconds,
)
from course_pkg.types import ServiceType, service_type

if TYPE_CHECKING:
    import genpy

HISTORY = 20  # The history contains at most this many calls.
LOGGER_SERVICES = ("/get_loggers", "/set_logger_level")


class Caller(Protocol):
    """Calls one service; another thread can end the running call with `cancel`."""

    def call(self, request: genpy.Message, /, *, timeout: float) -> genpy.Message:
        """Send a request message and return the response message; wait for at most `timeout` s."""

    def cancel(self) -> None:
        """End the running call; the call then raises CallCancelled."""

    def close(self) -> None:
        """Close the connection to the service."""


@dataclass(frozen=True)
class Offer:
    """A service on the graph: its name, the name of its type ("" if it is unknown), and the server's node."""

    name: str
    type: str
    node: str

    @property
    def tool(self) -> bool:
        """Whether the service is one of the two logger services that every node has."""
        return self.name.endswith(LOGGER_SERVICES)


class _Fresh(TypedDict):
    """The values of the panel's state that change with each new form."""

    form: FormState
    draft: Draft
    check: Check


class ServiceModel:
    """Selects a service, checks the form, calls the service, and stores a history of the calls.

    After each change, and in each phase of a call, the model calls the function `changed` with some of the
    keyword arguments `services`, `form`, `draft`, `check`, `outcome` and `history`. A thread holds the lock
    `turn` while it changes the model's state, but not while it waits for a response.
    """

    def __init__(
        self,
        connect: Callable[[str, ServiceType], Caller],
        changed: Callable[..., None],
        *,
        find_type: Callable[[str], ServiceType] = service_type,
        turn: threading.RLock | None = None,
    ) -> None:
        self.offers: tuple[Offer, ...] = ()
        self.service = ""
        self.form: RequestForm | None = None
        self.draft: Draft = {}
        self.response: genpy.Message | None = None
        self.history: deque[Entry] = deque(maxlen=HISTORY)
        self._connect = connect
        self._changed = changed
        self._find_type = find_type
        self._turn = turn or threading.RLock()
        self._caller: Caller | None = None
        self._under_way: Call | None = None
        self._refusals = 0
        self._calls = 0
        self._problem = ""

    def offer(self, offers: Iterable[Offer]) -> None:
        """Store the list of the services that are on the graph.

        The selected service stays selected, even if it has left the graph.
        """
        with self._turn:
            self.offers = tuple(sorted(offers, key=lambda each: (each.tool, each.name)))
            services = [{**asdict(each), "tool": each.tool} for each in self.offers]
            if not self.service:
                self._changed(services=services)
            elif self._type_changed():
                self._changed(services=services, **self._fresh())
            else:
                self._changed(services=services, form=self._described())

    def pick(self, name: str) -> None:
        """Select a service by name, even if it is not on the graph yet."""
        with self._turn:
            if name != self.service:
                self.cancel()
                self.service = name
                self.response = None
                self._changed(outcome={"phase": "idle"}, **self._fresh())

    def edit(self, draft: Draft) -> None:
        """Store the texts of the form; publish the errors in them, or the commands that make this call."""
        with self._turn:
            if self.form:
                self.draft = draft
                self._changed(check=self.form.checked(draft))

    def fill(self, values: Values) -> None:
        """Write values into the form; the other fields do not change.

        Raises FieldError if a value is not valid for its field. In this case, the form does not change.
        """
        with self._turn:
            form = self._need_form()
            self.draft = form.filled(self.draft, values)
            self._changed(draft=self.draft, check=form.checked(self.draft))

    def start(self, draft: Draft, deadline: str) -> None:
        """Call the service on a new thread; do nothing if a call is running or the form has an error."""
        with self._turn:
            if self._under_way or not self.form:
                return
            self.draft = draft
            try:
                call = self._begin(self.form, deadline)
            except FieldError as error:
                self._refuse(self.form, error)
                return
        threading.Thread(target=self._finish, args=(call,), daemon=True, name="panel-call").start()

    def call(self, deadline: str) -> Outcome:
        """Call the service on the calling thread, with the request in the form.

        Raises FieldError, NoServiceSelected or CallInProgress if no call can begin. A failed call raises its
        error.
        """
        with self._turn:
            form = self._need_form()
            if self._under_way:
                raise CallInProgress(
                    f"A call of {self.service} is running. Wait for the response, or cancel the call."
                )
            call = self._begin(form, deadline)
        outcome = self._finish(call)
        if call.error:
            raise call.error
        return outcome

    def record(self, inputs: Iterable[Values], deadline: str) -> list[Entry]:
        """Call the service once for each of the inputs; return an entry with the outcome for each call."""
        kept: list[Entry] = []
        for values in inputs:
            with self._turn:
                form = self._need_form()
                self.draft = form.filled(form.blank, values)
                call = self._begin(form, deadline)
            outcome = self._finish(call)
            kept.append({**call.entry(outcome), "check": form.checked(self.draft), "outcome": outcome})
        self._changed(draft=self.draft, check=kept[-1]["check"] if kept else {})
        return kept

    def cancel(self) -> None:
        """End the running call, if there is one."""
        if self._under_way and self._caller:
            self._caller.cancel()

    def close(self) -> None:
        """End the running call and close the connection."""
        self.cancel()
        self._let_go()

    def _found(self) -> Offer | None:
        return next((each for each in self.offers if each.name == self.service), None)

    def _type_changed(self) -> bool:
        found = self._found()
        return bool(found and found.type and (self.form is None or self.form.type.name != found.type))

    def _fresh(self) -> _Fresh:
        found = self._found()
        self._problem = ""
        before = self.form.type.name if self.form else ""
        self._let_go()
        self.form = None
        if found and found.type:
            try:
                self.form = RequestForm(self.service, self._find_type(found.type))
                if before and before != found.type:
                    self._problem = (
                        f"The type has changed from {before} to {found.type}, so the panel shows a new form."
                    )
            except CourseError as error:
                self._problem = str(error)
        self.draft = self.form.blank if self.form else {}
        check: Check = self.form.checked(self.draft) if self.form else {"errors": {}}
        return {"form": self._described(), "draft": self.draft, "check": check}

    def _described(self) -> FormState:
        found = self._found()
        problem = self._problem
        if not found:
            problem = (
                "No service with this name is on the graph now. Start the server of this service. Then the "
                "panel shows the service."
            )
        elif not found.type:
            problem = "The node of this service does not answer, so the type of the service is not known."
        node = found.node if found else ""
        state: FormState = {"service": self.service, "node": node, "problem": problem}
        return {**state, **self.form.described()} if self.form else state

    def _need_form(self) -> RequestForm:
        if not self.service:
            raise NoServiceSelected(
                "No service is selected. Select a service in the panel, or pass its name: "
                "ServicePanel('/getGeometry')."
            )
        if not self.form:
            raise NoServiceSelected(
                f"{self.service}: {self._described()['problem'] or 'its type is not known here.'}"
            )
        return self.form

    def _refuse(self, form: RequestForm, error: FieldError) -> None:
        errors = form.errors(self.draft)
        if error.field == DEADLINE:
            errors[DEADLINE] = correction(error)
        self._refusals += 1
        self._changed(check={"errors": errors, "refused": self._refusals})

    def _begin(self, form: RequestForm, deadline: str) -> Call:
        timeout = seconds(deadline)
        values = form.values(self.draft)
        self._calls += 1
        call = self._under_way = Call(self._calls, form, self.draft, values, timeout)
        self._caller = self._caller or self._connect(self.service, form.type)
        self._changed(outcome={"phase": "running", "number": call.number})
        return call

    def _finish(self, call: Call) -> Outcome:
        caller = self._caller
        began = time.perf_counter()
        try:
            request = call.form.type.request.to_message(call.values)
            if caller is None:
                raise CallCancelled(f"The panel does not show {call.form.service} any more.")
            response = caller.call(request, timeout=call.timeout)
            outcome = call.answered(response, 1000 * (time.perf_counter() - began))
        except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 - the panel shows the error
            outcome = call.failed(error, 1000 * (time.perf_counter() - began))
        with self._turn:
            if self._under_way is call:
                self._under_way = None
                self.response = call.response
                self.history.appendleft(call.entry(outcome))
                self._changed(outcome=outcome, history=list(self.history))
        return outcome

    def _let_go(self) -> None:
        self._under_way = None
        if self._caller:
            self._caller.close()
        self._caller = None
