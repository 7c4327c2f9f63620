"""The topic panel as a widget: a station while a page shows it, the model's state as traits."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

from traitlets import Dict, List, Unicode

from course_pkg.errors import GraphError
from course_pkg.graph.master import master_uri
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.station.neighbours import look_around
from course_pkg.graph.station.process import TopicStation
from course_pkg.interfaces import message_type
from course_pkg.panels.panel import Panel
from course_pkg.panels.topic.model import TopicModel
from course_pkg.panels.topic.settings import Settings

HERE = Path(__file__).parent


class TopicPanel(Panel):
    """Publish on a topic from a form, once or at a rate, and hear what it carries.

    `kind` is the type, such as "std_msgs/Float64"; without it the panel takes the type of the topic as soon
    as somebody publishes it. While a page shows it, the panel is a node of its own.
    Raises UnknownType, NotATopic.
    """

    front_end: ClassVar[Path] = HERE / "topic.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (
        HERE.parent / "forms" / "forms.css",
        HERE.parent / "plot" / "chart.css",
    )
    style_sheet: ClassVar[Path] = HERE / "topic.css"

    about = Dict(help="the topic, the fields of its type, the numbers in it").tag(sync=True)
    trouble = Unicode(help="why the graph cannot be seen").tag(sync=True)
    draft = Dict(help="the message as typed: a tree of texts").tag(sync=True, echo_update=False)
    settings = Dict(help="rate, queue, latch, and the number that is drawn").tag(sync=True, echo_update=False)
    check = Dict(help="what is wrong, or the commands that equal the form").tag(sync=True)
    around = Dict(help="who is on the topic, and whose type differs").tag(sync=True)
    spoken = Dict(help="what became of what was published").tag(sync=True)
    heard = Dict(help="how many messages came, and how evenly").tag(sync=True)
    echo: List[Any] = List(help="the last messages, the latest first").tag(sync=True)
    latest: List[Any] = List(help="the latest message, line by line").tag(sync=True)
    curve = Unicode(help="the points of the drawn number, as JSON").tag(sync=True)

    def __init__(self, topic: str, kind: Any = None) -> None:  # noqa: ANN401 - a name, a class, a MessageType
        found = message_type(kind) if kind is not None else None
        super().__init__()
        self._topic = topic if topic.startswith("/") else f"/{topic}"
        self._station: TopicStation | None = None
        with self.turn, self.hold_sync():
            self._model = TopicModel(self._topic, found, self.publish, self._tell, turn=self.turn)
            self._look()
        self.observe(self._edited, ["draft", "settings"])

    def shown(self) -> None:
        """Start the panel's node."""
        with self.turn:
            if self._station is None:
                self._station = TopicStation(self._topic, self._reported, self._lost)
                self._model.station_began()

    def hidden(self) -> None:
        """End it, and with it whatever it publishes."""
        with self.turn:
            station, self._station = self._station, None
        if station is not None:
            station.end()

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Answer a click."""
        if kind == "act":
            settings = Settings.taken(content["settings"])
            self._model.act(str(content["action"]), content["draft"], settings)
        elif kind == "stop":
            self._model.stop()
        elif kind == "withdraw":
            self._model.withdraw()
        self.send({"kind": "taken"})

    def __repr__(self) -> str:
        return f"TopicPanel({self._topic!r})"

    def _look(self) -> None:
        """See who is there before any page shows the panel, for a page that never has a kernel."""
        try:
            self._model.see(look_around(MasterClient(master_uri()), self._topic).as_dict())
        except GraphError as error:
            self.publish(trouble=str(error))

    def _tell(self, do: str, **what: Any) -> None:  # noqa: ANN401 - plain data
        if self._station is not None:
            self._station.tell(do, **what)

    def _edited(self, change: dict[str, Any]) -> None:
        if change["name"] == "draft" and change["new"] != self._model.draft:
            self._model.edit(change["new"])
        elif change["name"] == "settings" and (new := Settings.taken(change["new"])) != self._model.settings:
            self._model.set(new)

    def _reported(self, station: TopicStation, report: dict[str, Any]) -> None:
        with self.turn, self.hold_sync():
            if station is not self._station:
                return
            if report.get("trouble") and station.master != master_uri():
                self.hidden()  # the kernel has found another master since
                self.shown()
            else:
                self._model.report(report)

    def _lost(self, station: TopicStation, words: str) -> None:
        with self.turn:
            if station is self._station:
                self._station = None
                self.publish(trouble=words)
