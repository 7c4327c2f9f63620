"""The graph panel as a widget."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

from traitlets import Bool, List, Unicode

from course_pkg.graph import Node, Snapshot, look
from course_pkg.panels.follower import Follower
from course_pkg.panels.graph.model import GraphModel
from course_pkg.panels.panel import Panel

HERE = Path(__file__).parent


class GraphPanel(Panel):
    """A picture of the graph: nodes, the topics between them, and the services they serve.

    It follows the graph while a page shows it, or stays as it is now with `live=False`. `noise` shows what
    every graph has, too: /rosout and the logger services. With the kernel's own `node`, that one can be
    hidden.
    """

    front_end: ClassVar[Path] = HERE / "graph.js"
    style_sheet: ClassVar[Path] = HERE / "graph.css"

    drawing = Unicode(help="the picture as SVG").tag(sync=True)
    facts: List[Any] = List(help="each shape in words").tag(sync=True)
    trouble = Unicode(help="why there is no picture, or why it is old").tag(sync=True)
    live = Bool(help="whether the picture follows the graph").tag(sync=True)
    noise = Bool(help="whether /rosout and the logger services are shown").tag(sync=True)
    own = Unicode(help="the kernel's own node, which can be hidden").tag(sync=True)
    show_own = Bool(help="whether it is shown").tag(sync=True)

    def __init__(self, *, live: bool = True, noise: bool = False, node: Node | None = None) -> None:
        super().__init__()
        own = node.name if node else ""
        self._model = GraphModel(self.publish, noise=noise, own=own, turn=self.turn)
        self._follower: Follower[Snapshot] = Follower(look, self._model.see, self._lost)
        self.publish(live=live, noise=noise, own=own, show_own=True)
        self._follower.once()

    def shown(self) -> None:
        """Follow the graph."""
        if self.live:
            self._follower.start()

    def hidden(self) -> None:
        """Leave the graph alone."""
        self._follower.stop()

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Answer a click on one of the two boxes."""
        if kind == "choose":
            chosen = {"noise": bool(content["noise"]), "show_own": bool(content["show_own"])}
            self.publish(**chosen)
            self._model.choose(**chosen)

    def __repr__(self) -> str:
        return "GraphPanel()"

    def _lost(self, error: Exception) -> None:
        self._model.lose(str(error))
