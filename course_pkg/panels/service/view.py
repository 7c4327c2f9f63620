"""The widget of the service panel; its traits contain the model's state, and a click calls the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from traitlets import Dict, List, Unicode
from traitlets.utils.bunch import Bunch

from course_pkg.panels.forms.form import Values
from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.poller import Poller
from course_pkg.panels.service.model import Caller, Offer, ServiceModel
from course_pkg.ros import BoundedProxy, look
from course_pkg.types import Plain, ServiceType, service_type

if TYPE_CHECKING:
    import genpy

HERE = Path(__file__).parent


class ServicePanel(Panel):
    """A form for calling any service on the graph.

    `service` is the name of the service. If `service` is None, the reader selects a service on the page.
    `deadline` is the maximum time of a call in s. `kind` is the type of the service. `kind` is necessary only
    for a type that the notebook made and that belongs to no package. While a page shows the panel, the panel
    lists the services on the graph.
    """

    front_end: ClassVar[Path] = HERE / "service.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE.parent / "forms" / "forms.css",)
    style_sheet: ClassVar[Path] = HERE / "service.css"

    services = List(Dict(), help="the services on the graph").tag(sync=True)
    trouble = Unicode(help="why the graph cannot be read").tag(sync=True)
    form = Dict(help="the picked service and the fields of its type").tag(sync=True)
    draft = Dict(help="the typed request, as a tree of strings").tag(sync=True, echo_update=False)
    check = Dict(help=("the errors in the typed request, or the commands that make the same call")).tag(
        sync=True
    )
    deadline = Unicode(help="the typed deadline in seconds").tag(sync=True, echo_update=False)
    outcome = Dict(help="the phase and the result of the latest call").tag(sync=True)
    history = List(Dict(), help="earlier calls, the latest first").tag(sync=True)
    recording = List(Dict(), help="requests with their outcomes, for a page without a kernel").tag(sync=True)

    def __init__(
        self, service: str | None = None, *, kind: ServiceType | None = None, deadline: float = 5.0
    ) -> None:
        super().__init__()
        self._model = ServiceModel(_connect, self.publish, find_type=_finder(kind), turn=self.turn)
        self._poller = Poller(_look, self._seen, self._failed)
        with self.turn, self.hold_sync():
            self.deadline = f"{deadline:g}"
            self.outcome = {"phase": "idle"}
            self._poller.once()
            if service:
                self._model.pick(service if service.startswith(("/", "~")) else f"/{service}")
        self.observe(self._edited, "draft")

    @property
    def response(self) -> genpy.Message | None:
        """The response message of the latest call, or None if this call has no response."""
        return self._model.response

    def fill(self, **values: Plain) -> None:
        """Write values into the form; each keyword is the name of a field.

        Raises FieldError if a value is not valid for its field.
        """
        self._model.fill(values)

    def call(self, **values: Plain) -> genpy.Message | None:
        """Fill in the form, call the service, and return the response message.

        Raises FieldError, NoServiceSelected or CallInProgress if no call can begin. A failed call raises its
        error.
        """
        self._model.fill(values)
        self._model.call(self.deadline)
        return self.response

    def record(self, inputs: Iterable[Values]) -> None:
        """Call the service once for each of the inputs, and store the outcomes for pages without a kernel."""
        self.publish(recording=self._model.record(inputs, self.deadline))

    def shown(self) -> None:
        """Start to list the services on the graph."""
        self._poller.start()

    def hidden(self) -> None:
        """Stop listing the services on the graph."""
        self._poller.stop()

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on the page."""
        if kind == "pick":
            self._model.pick(str(content["service"]))
        elif kind == "call":
            self._model.start(content["draft"], str(content["deadline"]))
        elif kind == "cancel":
            self._model.cancel()

    def close(self) -> None:
        """Remove the panel from every page, end the running call, and stop listing the services."""
        super().close()
        self._model.close()

    def __repr__(self) -> str:
        return f"ServicePanel({self._model.service!r})" if self._model.service else "ServicePanel()"

    def _edited(self, change: Bunch) -> None:
        if change["new"] != self._model.draft:
            self._model.edit(change["new"])

    def _seen(self, offers: list[Offer]) -> None:
        with self.turn, self.hold_sync():
            self.trouble = ""
            self._model.offer(offers)

    def _failed(self, error: Exception) -> None:
        with self.turn, self.hold_sync():
            self.trouble = str(error)
            self._model.offer([])


def _finder(own: ServiceType | None) -> Callable[[str], ServiceType]:
    return lambda name: own if own and own.name == name else service_type(name)


def _connect(service: str, kind: ServiceType) -> Caller:
    caller: Caller = BoundedProxy(service, kind)
    return caller


def _look() -> list[Offer]:
    return [Offer(each.name, each.type, each.node) for each in look().services]
