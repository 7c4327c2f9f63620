"""The widget of the topic panel.

While a page shows the panel, a separate process publishes and receives messages.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

from traitlets import Dict, List, Unicode
from traitlets.utils.bunch import Bunch

from course_pkg.errors import GraphError
from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.topic.model import TopicModel
from course_pkg.panels.topic.settings import Settings
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.topic.connections import find_connections
from course_pkg.ros.topic.topic_process import TopicProcess
from course_pkg.types import MessageClass, MessageType, Plain, message_type

HERE = Path(__file__).parent


class TopicPanel(Panel):
    """A form for publishing on a topic, once or at a rate, and a view of the received messages.

    `kind` is the type, such as "std_msgs/Float64". If `kind` is None, the panel uses the type of the first
    publisher. While a page shows the panel, a separate node publishes and receives the messages. Raises
    UnknownType if there is no such type, and NotATopic if `topic` is not a valid name.
    """

    front_end: ClassVar[Path] = HERE / "topic.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE.parent / "forms" / "forms.css", HERE / "chart.css")
    style_sheet: ClassVar[Path] = HERE / "topic.css"

    about = Dict(help="the topic, the fields of its type, and the fields that are numbers").tag(sync=True)
    trouble = Unicode(help="why the graph cannot be read").tag(sync=True)
    draft = Dict(help="the typed message, as a tree of strings").tag(sync=True, echo_update=False)
    settings = Dict(help="rate, queue, latch, and the field that is drawn").tag(sync=True, echo_update=False)
    check = Dict(help=("the errors in the typed message, or the commands that publish the same message")).tag(
        sync=True
    )
    connections = Dict(help="the nodes on the topic, and nodes with another type").tag(sync=True)
    publisher = Dict(help="what happened to the published messages").tag(sync=True)
    subscription = Dict(help="the number of messages, and their timing").tag(sync=True)
    messages = List(Dict(), help="the last messages, the latest first").tag(sync=True)
    latest = List(Dict(), help="the latest message, line by line").tag(sync=True)
    curve = Unicode(help="the points of the drawn number, as JSON").tag(sync=True)

    def __init__(self, topic: str, kind: str | MessageType | MessageClass | None = None) -> None:
        found = message_type(kind) if kind is not None else None
        super().__init__()
        self._topic = topic if topic.startswith("/") else f"/{topic}"
        self._process: TopicProcess | None = None
        with self.turn, self.hold_sync():
            self._model = TopicModel(self._topic, found, self.publish, self._command, turn=self.turn)
            self._look()
        self.observe(self._edited, ["draft", "settings"])

    def shown(self) -> None:
        """Start the panel's node in a separate process."""
        with self.turn:
            if self._process is None:
                self._process = TopicProcess(self._topic, self._reported, self._lost)
                self._model.process_began()

    def hidden(self) -> None:
        """End the process of the panel's node."""
        with self.turn:
            process, self._process = self._process, None
        if process is not None:
            process.end()

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on the page."""
        if kind == "act":
            settings = Settings.of_page(content["settings"])
            self._model.act(str(content["action"]), content["draft"], settings)
        elif kind == "stop":
            self._model.stop()
        elif kind == "withdraw":
            self._model.withdraw()
        self.send({"kind": "taken"})

    def __repr__(self) -> str:
        return f"TopicPanel({self._topic!r})"

    def _look(self) -> None:
        """Find the publishers and subscribers of the topic once; a saved page then contains them, too."""
        try:
            self._model.see(find_connections(MasterClient(master_uri()), self._topic))
        except GraphError as error:
            self.publish(trouble=str(error))

    def _command(self, do: str, **arguments: Plain) -> None:
        if self._process is not None:
            self._process.tell(do, **arguments)

    def _edited(self, change: Bunch) -> None:
        if change["name"] == "draft" and change["new"] != self._model.draft:
            self._model.edit(change["new"])
        elif change["name"] == "settings":
            settings = Settings.of_page(change["new"])
            if settings != self._model.settings:
                self._model.set(settings)

    def _reported(self, process: TopicProcess, report: Any) -> None:  # noqa: ANN401 -- a Report, as JSON
        with self.turn, self.hold_sync():
            if process is not self._process:
                return
            if report.get("trouble") and process.master != master_uri():
                self.hidden()  # The kernel now uses another master, so the panel needs a new node.
                self.shown()
            else:
                self._model.report(report)

    def _lost(self, process: TopicProcess, message: str) -> None:
        with self.turn:
            if process is self._process:
                self._process = None
                self.publish(trouble=message)
