"""The state of a graph panel. The panel makes a drawing and details from snapshots of the ROS graph.

This module does not need ROS.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, TypedDict

from course_pkg.errors import DrawingFailed, InterfaceError
from course_pkg.panels.graph.activity import ActivityState, GraphActivity
from course_pkg.panels.graph.drawing import svg
from course_pkg.panels.graph.layout import Layout, laid_out
from course_pkg.panels.graph.picture import (
    Kind,
    Picture,
    Shape,
    folded,
    graph_text,
    namespaces,
    picture,
    space,
)
from course_pkg.types import Field, message_type, service_type

if TYPE_CHECKING:
    from course_pkg.ros import Activity, Snapshot

REFUSED = "refused"  # `reach` has this value for a node that is registered although its process has ended.
SHOWN = 12  # The details of a type list at most this many fields.

Pair = tuple[str, str]  # A pair contains a label and its text.
Describe = Callable[[Kind, str], list[Pair]]


class Fact(TypedDict):
    """The details of a shape.

    The page shows the details after a click on the shape, and in a list below the drawing.
    """

    key: str
    kind: str
    name: str
    lost: bool
    facts: list[Pair]


class Space(TypedDict):
    """A namespace on the page: an open frame, or one box if the namespace is folded."""

    name: str
    folded: bool


class Scene(TypedDict):
    """The values of the panel's state that are large and change rarely."""

    drawing: str
    facts: list[Fact]
    spaces: list[Space]
    trouble: str


def facts(picture: Picture, describe: Describe) -> list[Fact]:
    """Return the details of each namespace and of each shape, also of shapes in folded namespaces."""
    spaces = [space(name, picture, members) for name, members in namespaces(picture).items()]
    known: dict[Pair, list[Pair]] = {}
    return [_entry(each, _fields(each, describe, known)) for each in (*picture.shapes, *spaces)]


def fields_of(kind: Kind, name: str) -> list[Pair]:
    """Return the fields of the type `name`, as pairs of a label and a text."""
    try:
        if kind is Kind.TOPIC:
            return [("fields", _field_list(message_type(name).fields))]
        service = service_type(name)
    except InterfaceError as error:
        return [("fields", str(error).splitlines()[0])]
    return [
        ("request", _field_list(service.request.fields)),
        ("response", _field_list(service.response.fields)),
    ]


def _fields(shape: Shape, describe: Describe, known: dict[Pair, list[Pair]]) -> list[Pair]:
    name = dict(shape.facts).get("type", "")
    if "/" not in name:
        return []  # The type is unknown.
    what = (shape.kind.value, name)
    if what not in known:
        known[what] = describe(shape.kind, name)
    return known[what]


def _field_list(fields: Iterable[Field]) -> str:
    named = [f"{each.type} {each.name}" for each in fields]
    more = [f"and {len(named) - SHOWN} more"] if len(named) > SHOWN else []
    return ", ".join(named[:SHOWN] + more) or "none"


def _entry(shape: Shape, fields: list[Pair]) -> Fact:
    kept = list(shape.facts)
    # In the details, the fields come directly after the pair with the label "type".
    at = next((number for number, (label, _) in enumerate(kept, start=1) if label == "type"), 0)
    return {
        "key": shape.key,
        "kind": shape.kind.value,
        "name": shape.name,
        "lost": not shape.reachable,
        "facts": [*kept[:at], *fields, *kept[at:]],
    }


class GraphModel:
    """Converts snapshots of the ROS graph into a drawing; it makes a new drawing only after a change.

    The model calls the function `changed` with the keyword arguments `drawing` (SVG, or "" if graphviz cannot
    draw), `facts` (the details of each shape and namespace), `spaces` (the shown namespaces), `activity` (see
    ActivityState), and `trouble` (an error message, or ""). `own` is the name of the node that runs in the
    kernel; the reader can hide this node.
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
        self._counts = GraphActivity()
        self.scene: Scene = {"drawing": "", "facts": [], "spaces": [], "trouble": ""}
        self.activity: ActivityState = {}

    def see(self, snapshot: Snapshot) -> None:
        """Store a new snapshot of the graph, and draw the graph if the picture has changed."""
        self.snapshot = snapshot
        self._draw()

    def count(self, activity: Activity) -> None:
        """Store the counts of messages and calls; this method never changes the drawing."""
        with self._turn:
            self._counts.read(activity)
            if self._shown is not None and (state := self._activity_now()) != self.activity:
                self.activity = state
                self._changed(activity=state)

    def lose(self, reason: str) -> None:
        """Show the last picture, and the reason why the panel cannot read the graph."""
        with self._turn:
            self._shown = None
            self.scene = {**self.scene, "trouble": reason}
            self._changed(trouble=reason)

    def choose(self, *, noise: bool, show_own: bool) -> None:
        """Show or hide /rosout and the logger services (`noise`), and the kernel's own node (`show_own`)."""
        self.noise, self.show_own = noise, show_own
        self._draw()

    def fold(self, name: str, *, fold: bool) -> None:
        """Fold or unfold a namespace; the name "" means all namespaces of the picture."""
        names = [name] if name else namespaces(self._whole)
        self._choices |= dict.fromkeys(names, fold)
        self._draw()

    def still(self) -> str:
        """Return the drawing as the text of an SVG file, with its style sheet and the latest rates."""
        title = f"The ROS graph: {_counts(self._shown or Picture())}"
        words = graph_text(self.snapshot, noise=self.noise) if self.snapshot else ""
        notes = self.activity.get("notes", {})
        return svg(self._layout, title=title, description=words, notes=notes, still=True)

    def _draw(self) -> None:
        """Draw the picture if it differs from the previous picture.

        The page must not wait for graphviz, so the method releases the lock while graphviz runs. If another
        thread begins to draw during this time, this call discards its own result.
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
            words = f"{_counts(shown)}. The list after the drawing contains the same information as text."
            drawing = svg(layout, description=words) if shown.shapes else ""
        except DrawingFailed as error:
            trouble = str(error)
        known = facts(whole, self._describe)
        with self._turn:
            if self._shown is not shown:
                return
            self._layout, self.activity = layout, self._activity_now()
            self.scene = {"drawing": drawing, "facts": known, "spaces": _spaces(shown), "trouble": trouble}
            self._changed(activity=self.activity, **self.scene)

    def _activity_now(self) -> ActivityState:
        assert self.snapshot is not None
        alive = {node.name for node in self.snapshot.nodes if node.reach != REFUSED}
        return self._counts.state(self._whole, alive, self._box)

    def _box(self, key: str) -> str:
        """Return the key itself, or the key of the folded namespace that hides the shape with this key."""
        boxes = [each for each in (self._shown or Picture()).shapes if each.kind is Kind.SPACE]
        name = key.split(" ", 1)[1]
        return next((each.key for each in boxes if name.startswith(each.name)), key)


def _spaces(shown: Picture) -> list[Space]:
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
