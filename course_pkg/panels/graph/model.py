"""What a graph panel knows, with no page and no ROS: snapshots come in, a drawing and its facts come out."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from course_pkg.errors import DrawingFailed
from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.layout import Layout, laid_out
from course_pkg.panels.graph.picture import Kind, Picture, picture

if TYPE_CHECKING:
    from course_pkg.graph import Snapshot

State = dict[str, Any]


class GraphModel:
    """Turns snapshots into a drawing, anew only when what is shown differs.

    `changed` hears by keyword of `drawing` (SVG, "" when graphviz cannot draw), `facts` (one entry for
    each shape) and `trouble` (a sentence, "" when all is well). `own` is the kernel's node, which can be
    hidden.
    """

    def __init__(
        self,
        changed: Callable[..., None],
        *,
        noise: bool = False,
        own: str = "",
        arrange: Callable[[Picture], Layout] = laid_out,
        turn: threading.RLock | None = None,
    ) -> None:
        self.noise = noise
        self.own = own
        self.show_own = True
        self._changed = changed
        self._arrange = arrange
        self._turn = turn or threading.RLock()
        self._snapshot: Snapshot | None = None
        self._shown: Picture | None = None

    def see(self, snapshot: Snapshot) -> None:
        """Take in how the graph looks now."""
        self._snapshot = snapshot
        self._draw()

    def lose(self, reason: str) -> None:
        """Keep the last picture, and say why it is old: the graph cannot be seen."""
        self._shown = None
        with self._turn:
            self._changed(trouble=reason)

    def choose(self, *, noise: bool, show_own: bool) -> None:
        """Show or hide what every graph has, and the kernel's own node."""
        self.noise, self.show_own = noise, show_own
        self._draw()

    def _draw(self) -> None:
        if self._snapshot is None:
            return
        shown = picture(self._snapshot, noise=self.noise, hide=() if self.show_own else (self.own,))
        if shown == self._shown:
            return
        self._shown = shown
        trouble, drawing = "", ""
        try:
            drawing = svg(self._arrange(shown), description=_description(shown)) if shown.shapes else ""
        except DrawingFailed as error:
            trouble = str(error)
        with self._turn:
            self._changed(drawing=drawing, facts=_facts(shown), trouble=trouble)


def _facts(shown: Picture) -> list[State]:
    return [
        {
            "key": each.key,
            "kind": each.kind.value,
            "name": each.name,
            "lost": not each.reachable,
            "facts": list(each.facts),
        }
        for each in shown.shapes
    ]


def _description(shown: Picture) -> str:
    counts = {kind: sum(each.kind is kind for each in shown.shapes) for kind in Kind}
    parts = [f"{count} {kind.value}{'' if count == 1 else 's'}" for kind, count in counts.items()]
    return ", ".join(parts) + ". The list after the drawing says the same in words."
