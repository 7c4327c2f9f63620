"""The graph panel as a widget."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any, ClassVar

from traitlets import Bool, Dict, List, Unicode

from course_pkg.graph import Activity, Listener, Node, Snapshot, look, this_node
from course_pkg.panels.follower import Follower
from course_pkg.panels.graph.history import SCENE, History
from course_pkg.panels.graph.model import GraphModel
from course_pkg.panels.panel import Panel

HERE = Path(__file__).parent
SILENT = "silent"  # of a node that takes connections and does not answer
CALM = 2.0  # s between two looks at what the nodes have counted


class GraphPanel(Panel):
    """A picture of the graph: nodes, the topics between them, and the services they serve.

    It follows the graph while a page shows it, or stays as it is now with `live=False`: with how often
    topics carry messages, and who called a service lately. `noise` shows what every graph has, too: /rosout
    and the logger services. The kernel's own `node`, by default what join() made of it, can be hidden.
    What it showed on its last page is kept, and can be played again where no kernel answers.
    """

    front_end: ClassVar[Path] = HERE / "graph.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE / "drawing.css",)
    style_sheet: ClassVar[Path] = HERE / "graph.css"

    drawing = Unicode(help="the picture as SVG").tag(sync=True)
    facts: List[Any] = List(help="each shape and namespace in words").tag(sync=True)
    spaces: List[Any] = List(help="the namespaces, and whether they are folded").tag(sync=True)
    activity = Dict(help="rates of topics, callers of services").tag(sync=True)
    history = Dict(help="what was shown on the last page; see history.py").tag(sync=True)
    trouble = Unicode(help="why there is no picture, or why it is old").tag(sync=True)
    live = Bool(help="whether the picture follows the graph").tag(sync=True)
    noise = Bool(help="whether /rosout and the logger services are shown").tag(sync=True)
    own = Unicode(help="the kernel's own node, which can be hidden").tag(sync=True)
    show_own = Bool(help="whether it is shown").tag(sync=True)

    def __init__(self, *, live: bool = True, noise: bool = False, node: Node | None = None) -> None:
        super().__init__()
        ours = node or this_node()
        own = ours.name if ours else ""
        self._history = History()
        self._model = GraphModel(self._changed, noise=noise, own=own, turn=self.turn)
        self._follower: Follower[Snapshot] = Follower(self._look, self._model.see, self._lost)
        self._ear = Listener()
        self._listener: Follower[Activity] = Follower(
            self._listen, self._model.hear, self.complain, every=CALM
        )
        self.publish(live=live, noise=noise, own=own, show_own=True)
        self._follower.once()
        self._listener.once()

    def svg(self) -> str:
        """Return the picture as it is now as an SVG file of its own, fit for a page and for print."""
        return self._model.still()

    def shown(self) -> None:
        """Follow the graph, and keep what it shows."""
        if self.live:
            self._remember()
            self._follower.start()
            self._listener.start()

    def hidden(self) -> None:
        """Leave the graph alone, and hand over what was kept, at once: a page that shows it pays nothing."""
        self._follower.stop()
        self._listener.stop()
        with self.turn:
            self._history.stop()
            self.publish(history=self._history.state(time.time()))

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Answer a click: on one of the two boxes, or on a namespace."""
        if kind == "choose":
            chosen = {"noise": bool(content["noise"]), "show_own": bool(content["show_own"])}
            self.publish(**chosen)
            self._model.choose(**chosen)
        elif kind == "fold":
            self._model.fold(str(content["name"]), fold=bool(content["fold"]))

    def __repr__(self) -> str:
        return "GraphPanel()"

    def _changed(self, **traits: object) -> None:
        with self.turn:
            self.publish(**traits)
            self._history.note(time.time(), **self._showing())

    def _remember(self) -> None:
        with self.turn:
            if not self._history.running:  # or another view of it has begun already
                self.publish(history={})
                self._history.start(time.time(), **self._showing())

    def _showing(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in (*SCENE, "activity")}

    def _look(self) -> Snapshot:
        """Look at the graph; again where a node did not answer in time for once: the machine may be busy."""
        before, now = self._model.snapshot, look()
        awake = {node.name for node in before.nodes if node.reachable} if before else set()
        late = any(node.reach == SILENT and node.name in awake for node in now.nodes)
        return look() if late else now

    def _listen(self) -> Activity:
        snapshot = self._model.snapshot
        return self._ear.listen(snapshot) if snapshot else Activity(0.0)

    def _lost(self, error: Exception) -> None:
        self._model.lose(str(error))
