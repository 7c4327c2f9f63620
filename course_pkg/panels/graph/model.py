"""What a graph panel knows, with no page and no ROS: snapshots come in, a drawing and its facts come out."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from course_pkg.errors import DrawingFailed
from course_pkg.panels.graph.doings import Doings
from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.facts import Describe, facts, fields_of
from course_pkg.panels.graph.folding import folded, namespaces
from course_pkg.panels.graph.layout import Layout, laid_out
from course_pkg.panels.graph.picture import Kind, Picture, graph_text, picture

if TYPE_CHECKING:
    from course_pkg.graph import Activity, Snapshot

State = dict[str, Any]
REFUSED = "refused"  # of a node whose process has ended, and that is still registered


class GraphModel:
    """Turns snapshots into a drawing, anew only when what is shown differs.

    `changed` hears by keyword of `drawing` (SVG, "" when graphviz cannot draw), `facts` (one entry for
    each shape and namespace), `spaces` (which namespaces there are, and whether they are folded), `activity`
    (see Doings.told), and `trouble` (a sentence, "" when all is well). `own` is the kernel's node, which can
    be hidden.
    """

    def __init__(
        self,
        changed: Callable[..., None],
        *,
        noise: bool = False,
        own: str = "",
        arrange: Callable[[Picture], Layout] = laid_out,
        describe: Describe = fields_of,
        turn: threading.RLock | None = None,
    ) -> None:
        self.noise = noise
        self.own = own
        self.show_own = True
        self.snapshot: Snapshot | None = None
        self._changed = changed
        self._arrange = arrange
        self._describe = describe
        self._turn = turn or threading.RLock()
        self._choices: dict[str, bool] = {}
        self._whole = Picture()
        self._shown: Picture | None = None
        self._layout = Layout()
        self._doings = Doings()
        self._activity: State = {}

    def see(self, snapshot: Snapshot) -> None:
        """Take in how the graph looks now."""
        self.snapshot = snapshot
        self._draw()

    def hear(self, activity: Activity) -> None:
        """Take in what the nodes have counted until now; this never changes the drawing."""
        with self._turn:
            self._doings.read(activity)
            if self._shown is not None and (told := self._told()) != self._activity:
                self._activity = told
                self._changed(activity=told)

    def lose(self, reason: str) -> None:
        """Keep the last picture, and say why it is old: the graph cannot be seen."""
        with self._turn:
            self._shown = None
            self._changed(trouble=reason)

    def choose(self, *, noise: bool, show_own: bool) -> None:
        """Show or hide what every graph has, and the kernel's own node."""
        self.noise, self.show_own = noise, show_own
        self._draw()

    def fold(self, name: str, *, fold: bool) -> None:
        """Fold a namespace, or unfold it; "" stands for all that there are now."""
        names = [name] if name else namespaces(self._whole)
        self._choices |= dict.fromkeys(names, fold)
        self._draw()

    def still(self) -> str:
        """Return the drawing as a file of its own, with its style and the latest rates."""
        title = f"The ROS graph: {_counts(self._shown or Picture())}"
        words = graph_text(self.snapshot, noise=self.noise) if self.snapshot else ""
        notes = self._activity.get("notes", {})
        return svg(self._layout, title=title, description=words, notes=notes, still=True)

    def _draw(self) -> None:
        """Draw what is shown, if it is another than before.

        Graphviz is not waited for in a turn of its own: the page would wait, too. So it may be overtaken.
        """
        with self._turn:
            if self.snapshot is None:
                return
            whole = picture(self.snapshot, noise=self.noise, hide=() if self.show_own else (self.own,))
            shown = folded(whole, self._choices)
            if shown == self._shown and whole == self._whole:
                return
            self._whole, self._shown = whole, shown
        layout, trouble, drawing = Layout(), "", ""
        try:
            layout = self._arrange(shown)
            words = f"{_counts(shown)}. The list after the drawing says the same in words."
            drawing = svg(layout, description=words) if shown.shapes else ""
        except DrawingFailed as error:
            trouble = str(error)
        said = facts(whole, self._describe)
        with self._turn:
            if self._shown is not shown:
                return
            self._layout, self._activity = layout, self._told()
            self._changed(
                drawing=drawing,
                facts=said,
                spaces=_spaces(shown),
                activity=self._activity,
                trouble=trouble,
            )

    def _told(self) -> State:
        assert self.snapshot is not None
        alive = {node.name for node in self.snapshot.nodes if node.reach != REFUSED}
        return self._doings.told(self._whole, alive, self._box)

    def _box(self, key: str) -> str:
        """Return the key of the shape in which one is drawn: its own, or that of a folded namespace."""
        boxes = [each for each in (self._shown or Picture()).shapes if each.kind is Kind.SPACE]
        name = key.split(" ", 1)[1]
        return next((each.key for each in boxes if name.startswith(each.name)), key)


def _spaces(shown: Picture) -> list[State]:
    """Return the namespaces that are to be seen, as a frame or as a box."""
    frames = {each.name for each in shown.frames}
    boxes = {each.name for each in shown.shapes if each.kind is Kind.SPACE}
    return [{"name": name, "folded": name in boxes} for name in sorted(frames | boxes)]


def _counts(shown: Picture) -> str:
    counts = {kind: sum(each.kind is kind for each in shown.shapes) for kind in Kind}
    parts = [
        f"{count} {kind.value}{'' if count == 1 else 's'}"
        for kind, count in counts.items()
        if count or kind is not Kind.SPACE
    ]
    return ", ".join(parts)
