"""What a service panel knows, with no page, no kernel and no ROS: who offers and who calls is injected."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any, Protocol

from course_pkg.errors import CallCancelled, CallUnderWay, CourseError, FieldError, NothingPicked
from course_pkg.graph.explanations import known
from course_pkg.interfaces import ServiceType, service_type
from course_pkg.panels.forms.form import State, correction
from course_pkg.panels.forms.rows import rows, summary
from course_pkg.panels.forms.texts import Texts, compact
from course_pkg.panels.service.form import DEADLINE, RequestForm, seconds

HISTORY = 20
TOOLS = ("/get_loggers", "/set_logger_level")


class Caller(Protocol):
    """Calls one service; `cancel` ends a call under way on another thread."""

    def call(self, request: Any, /, *, timeout: float) -> Any:  # noqa: ANN401 - generated message classes
        """Send a request message and return the response message, within `timeout` s."""

    def cancel(self) -> None:
        """Make the call under way raise CallCancelled."""

    def close(self) -> None:
        """Let go of what a call needs."""


@dataclass(frozen=True)
class Offer:
    """A service on the graph: its name, its type by name ("" if nobody could say), who serves it."""

    name: str
    type: str
    node: str

    @property
    def tool(self) -> bool:
        """Whether it is one of the two services that every node brings for its logger."""
        return self.name.endswith(TOOLS)


class ServiceModel:
    """Picks a service, checks what is typed, calls, remembers.

    `changed` hears of every change, once for each phase, by keyword: `services`, `form`, `draft`, `check`,
    `outcome`, `history`. `turn` is held while the state changes, never while a call is under way.
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
        self.draft: Texts = {}
        self.response: Any = None
        self.history: deque[State] = deque(maxlen=HISTORY)
        self._connect = connect
        self._changed = changed
        self._find_type = find_type
        self._turn = turn or threading.RLock()
        self._caller: Caller | None = None
        self._under_way: _Call | None = None
        self._refusals = 0
        self._calls = 0
        self._problem = ""

    def offer(self, offers: Iterable[Offer]) -> None:
        """Take in the services that are on the graph now; what is picked stays picked when it has gone."""
        with self._turn:
            self.offers = tuple(sorted(offers, key=lambda each: (each.tool, each.name)))
            parts: State = {"services": [{**asdict(each), "tool": each.tool} for each in self.offers]}
            if self.service:
                parts |= self._followed()
            self._changed(**parts)

    def pick(self, name: str) -> None:
        """Turn to a service by name; it need not be on the graph yet."""
        with self._turn:
            if name != self.service:
                self.cancel()
                self.service = name
                self.response = None
                self._changed(outcome={"phase": "idle"}, **self._fresh())

    def edit(self, draft: Texts) -> None:
        """Take in what is typed now and say what it amounts to."""
        with self._turn:
            if self.form:
                self.draft = draft
                self._changed(check=self.form.checked(draft))

    def fill(self, values: Mapping[str, Any]) -> None:
        """Write plain values into the form; fields that are not named keep what they have.

        Raises FieldError when a value does not fit, and leaves the form as it was.
        """
        with self._turn:
            form = self._need_form()
            self.draft = form.filled(self.draft, values)
            self._changed(draft=self.draft, check=form.checked(self.draft))

    def start(self, draft: Texts, deadline: str) -> None:
        """Call on a thread of its own, unless a call is under way or the form is not right."""
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

    def call(self, deadline: str) -> State:
        """Call on this thread with what stands in the form. Raises what the call raises."""
        with self._turn:
            form = self._need_form()
            if self._under_way:
                raise CallUnderWay(
                    f"{self.service} is being called already: wait for the answer, or cancel that call."
                )
            call = self._begin(form, deadline)
        outcome = self._finish(call)
        if call.error:
            raise call.error
        return outcome

    def record(self, inputs: Iterable[Mapping[str, Any]], deadline: str) -> list[State]:
        """Call once for each of the inputs and return what came back, for a page with no kernel."""
        kept: list[State] = []
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
        """End the call under way, if there is one."""
        if self._under_way and self._caller:
            self._caller.cancel()

    def close(self) -> None:
        """End what is under way and let go of the service."""
        self.cancel()
        self._let_go()

    def _found(self) -> Offer | None:
        return next((each for each in self.offers if each.name == self.service), None)

    def _followed(self) -> State:
        """Return the form after a look at the graph: a new one only when the type is another."""
        found = self._found()
        if found and found.type and (self.form is None or self.form.type.name != found.type):
            return self._fresh()
        return {"form": self._described()}

    def _fresh(self) -> State:
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
                        f"Its type was {before} and is now {found.type}, so the form is a new one."
                    )
            except CourseError as error:
                self._problem = str(error)
        self.draft = self.form.blank if self.form else {}
        check = self.form.checked(self.draft) if self.form else {"errors": {}}
        return {"form": self._described(), "draft": self.draft, "check": check}

    def _described(self) -> State:
        found = self._found()
        problem = self._problem
        if not found:
            problem = (
                "No service of this name is on the graph now. The panel follows the graph: start its server."
            )
        elif not found.type:
            problem = "Its node does not answer, so nobody can say of which type it is."
        state = {"service": self.service, "node": found.node if found else "", "problem": problem}
        return state | (self.form.described() if self.form else {})

    def _need_form(self) -> RequestForm:
        if not self.service:
            raise NothingPicked(
                "No service is picked. Pick one in the panel or name it: ServicePanel('/getGeometry')."
            )
        if not self.form:
            raise NothingPicked(
                f"{self.service}: {self._described()['problem'] or 'its type is not known here.'}"
            )
        return self.form

    def _refuse(self, form: RequestForm, error: FieldError) -> None:
        errors = form.errors(self.draft)
        if error.field == DEADLINE:
            errors[DEADLINE] = correction(error)
        self._refusals += 1
        self._changed(check={"errors": errors, "refused": self._refusals})

    def _begin(self, form: RequestForm, deadline: str) -> _Call:
        limit = seconds(deadline)
        values = form.values(self.draft)
        self._calls += 1
        call = self._under_way = _Call(self._calls, form, self.draft, values, limit)
        self._caller = self._caller or self._connect(self.service, form.type)
        self._changed(outcome={"phase": "running", "number": call.number})
        return call

    def _finish(self, call: _Call) -> State:
        caller = self._caller
        began = time.perf_counter()
        try:
            if caller:
                call.response = caller.call(
                    call.form.type.request.to_message(call.values), timeout=call.limit
                )
            outcome = call.answered(1000 * (time.perf_counter() - began))
        except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 - it is what the panel shows
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


@dataclass
class _Call:
    """One call, from the request as typed to what came of it."""

    number: int
    form: RequestForm
    draft: Texts
    values: dict[str, Any]
    limit: float
    response: Any = None
    error: BaseException | None = None

    def answered(self, milliseconds: float) -> State:
        """Return the outcome for the page, with the response as lines of text."""
        answer = self.form.type.response
        lines = rows(answer.fields, compact(answer.fields, answer.format(answer.to_values(self.response))))
        return self._outcome("done", milliseconds) | {"rows": lines}

    def failed(self, error: BaseException, milliseconds: float) -> State:
        """Return the outcome for the page: the error as it was worded, and what it means."""
        self.error = error
        name, words = type(error).__name__, str(error)
        explanation = known(f"{name}: {words}")
        said = {"name": name, "words": words} | (explanation.as_dict() if explanation else {})
        phase = "cancelled" if isinstance(error, (CallCancelled, KeyboardInterrupt)) else "failed"
        return self._outcome(phase, milliseconds) | {"error": said}

    def _outcome(self, phase: str, milliseconds: float) -> State:
        digits = 1 if milliseconds < 1000 else 0
        at = time.strftime("%H:%M:%S")
        return {"phase": phase, "number": self.number, "at": at, "ms": round(milliseconds, digits)}

    def entry(self, outcome: State) -> State:
        """Return the call as a line of the history: what was asked and what was said."""
        answer = (
            summary(outcome["rows"]) or "an empty response"
            if self.error is None
            else outcome["error"]["name"]
        )
        asked = summary(rows(self.form.type.request.fields, self.draft)) or "an empty request"
        line = {key: outcome[key] for key in ("phase", "number", "at", "ms")}
        return line | {"draft": self.draft, "asked": asked, "said": answer}
