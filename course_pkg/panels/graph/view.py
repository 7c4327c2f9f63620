"""The widget of the graph panel."""

from __future__ import annotations

import time
from pathlib import Path
from typing import ClassVar

from traitlets import Bool, Dict, List, Unicode

from course_pkg.panels.graph.activity import ActivityState
from course_pkg.panels.graph.history import History
from course_pkg.panels.graph.model import GraphModel, Scene
from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.poller import Poller
from course_pkg.ros import Activity, ActivityPoller, Node, Snapshot, look, this_node

HERE = Path(__file__).parent
SILENT = "silent"  # `reach` has this value for a node that accepts connections but does not answer.
PAUSE = 2.0  # PAUSE is the time in s between two readings of the nodes' counters.


class GraphPanel(Panel):
    """A picture of the graph: the nodes, their topics, and their services.

    The panel updates the picture while a page shows the panel. If `live` is False, the panel keeps the first
    picture. The picture shows the rates of topics and the latest callers of services. If `noise` is True, the
    picture also shows /rosout and the logger services of every node. `node` is the node in the kernel, by
    default the node that join() created; the reader can hide this node. The panel records all pictures; a
    page without a kernel can then play them.
    """

    front_end: ClassVar[Path] = HERE / "graph.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE / "drawing.css",)
    style_sheet: ClassVar[Path] = HERE / "graph.css"

    drawing = Unicode(help="the picture as SVG").tag(sync=True)
    facts = List(Dict(), help="the details of each shape and namespace").tag(sync=True)
    spaces = List(Dict(), help="the namespaces, and whether they are folded").tag(sync=True)
    activity = Dict(help="the rates of topics and the callers of services").tag(sync=True)
    history = Dict(help="the recording for a page without a kernel; see history.py").tag(sync=True)
    trouble = Unicode(help="why there is no picture, or why the picture is out of date").tag(sync=True)
    live = Bool(help="whether the picture follows the graph").tag(sync=True)
    noise = Bool(help="whether /rosout and the logger services are shown").tag(sync=True)
    own = Unicode(help="the kernel's own node, which can be hidden").tag(sync=True)
    show_own = Bool(help="whether the kernel's own node is shown").tag(sync=True)

    def __init__(self, *, live: bool = True, noise: bool = False, node: Node | None = None) -> None:
        super().__init__()
        ours = node or this_node()
        own = ours.name if ours else ""
        self._history = History()
        self._model = GraphModel(self._changed, noise=noise, own=own, turn=self.turn)
        self._snapshots: Poller[Snapshot] = Poller(self._look, self._model.see, self._failed)
        self._activity = ActivityPoller()
        self._counts: Poller[Activity] = Poller(self._count, self._model.count, self.complain, every=PAUSE)
        self.publish(live=live, noise=noise, own=own, show_own=True)
        self._snapshots.once()
        self._counts.once()

    def svg(self) -> str:
        """Return the current picture as the text of an SVG file, for a page or for print."""
        return self._model.still()

    def shown(self) -> None:
        """Start to read the graph repeatedly and to record the pictures."""
        if self.live:
            self._record()
            self._snapshots.start()
            self._counts.start()

    def hidden(self) -> None:
        """Stop reading the graph, and send the recording to the page; a saved page can then play it."""
        self._snapshots.stop()
        self._counts.stop()
        with self.turn:
            self._history.stop()
            self.publish(history=self._history.state(time.time()))

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on a check box or on a namespace."""
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
            self._history.add(time.time(), *self._showing())

    def _record(self) -> None:
        with self.turn:
            if not self._history.running:  # Another view of the panel may have started the recording.
                self.publish(history={})
                self._history.start(time.time(), *self._showing())

    def _showing(self) -> tuple[Scene, ActivityState]:
        return self._model.scene, self._model.activity

    def _look(self) -> Snapshot:
        """Return a snapshot of the graph.

        If a node does not answer, take a second snapshot: the machine may be busy.
        """
        before, now = self._model.snapshot, look()
        awake = {node.name for node in before.nodes if node.reachable} if before else set()
        late = any(node.reach == SILENT and node.name in awake for node in now.nodes)
        return look() if late else now

    def _count(self) -> Activity:
        snapshot = self._model.snapshot
        return self._activity.poll(snapshot) if snapshot else Activity(0.0)

    def _failed(self, error: Exception) -> None:
        self._model.lose(str(error))
