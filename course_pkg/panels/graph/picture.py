"""The graph as shapes and lines without positions; layout.py computes the positions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from course_pkg.ros import Snapshot

CROWD = 30  # In a picture with more shapes than this, namespaces are folded until the reader unfolds them.
NOISE_NODES = frozenset({"/rosout"})
NOISE_TOPICS = frozenset({"/rosout", "/rosout_agg"})
NOISE_SERVICES = ("/get_loggers", "/set_logger_level")


class Kind(str, Enum):
    """The kind of a shape."""

    NODE = "node"
    TOPIC = "topic"
    SERVICE = "service"
    SPACE = "namespace"  # This shape is a folded namespace.


PLURALS = {Kind.NODE: "nodes", Kind.TOPIC: "topics", Kind.SERVICE: "services"}


@dataclass(frozen=True)
class Shape:
    """One node, topic, service or folded namespace; `facts` are the pairs (label, value) of its details."""

    kind: Kind
    name: str
    facts: tuple[tuple[str, str], ...] = ()
    reachable: bool = True

    @property
    def key(self) -> str:
        """The kind and the name of the shape, because a topic and a service can have the same name."""
        return f"{self.kind.value} {self.name}"


@dataclass(frozen=True)
class Line:
    """A connection between two shapes; `both` is True if data flows in both directions, as for a service."""

    tail: str
    head: str
    both: bool = False


@dataclass(frozen=True)
class Frame:
    """A namespace that is not folded, such as "/turtle1/".

    `members` are the keys of all shapes in this namespace.
    """

    name: str
    members: frozenset[str]

    @property
    def key(self) -> str:
        """The key of the namespace. A frame and a folded box of the same namespace have the same key."""
        return f"{Kind.SPACE.value} {self.name}"


@dataclass(frozen=True)
class Picture:
    """All shapes, lines and frames.

    The shapes, the lines and the frames are sorted by name, so an outer frame comes before its inner frames.
    """

    shapes: tuple[Shape, ...] = ()
    lines: tuple[Line, ...] = ()
    frames: tuple[Frame, ...] = ()


def picture(snapshot: Snapshot, *, noise: bool = False, hide: Iterable[str] = ()) -> Picture:
    """Return the shapes and lines of a snapshot.

    If `noise` is False, /rosout and the logger services of every node are left out. `hide` contains the names
    of nodes that are left out. The services of hidden nodes, and the topics that only hidden nodes use, are
    also left out.
    """
    hidden = frozenset(hide) | (frozenset() if noise else NOISE_NODES)
    shapes = [
        Shape(Kind.NODE, node.name, (("address", node.uri or "unknown"),), node.reachable)
        for node in snapshot.nodes
        if node.name not in hidden
    ]
    lines: list[Line] = []
    for topic in snapshot.topics:
        publishers = [name for name in topic.publishers if name not in hidden]
        subscribers = [name for name in topic.subscribers if name not in hidden]
        if not (publishers or subscribers) or (not noise and topic.name in NOISE_TOPICS):
            continue
        shape = Shape(Kind.TOPIC, topic.name, _topic_facts(topic.type, publishers, subscribers))
        shapes.append(shape)
        lines += [Line(_node(name), shape.key) for name in publishers]
        lines += [Line(shape.key, _node(name)) for name in subscribers]
    for service in snapshot.services:
        if service.node in hidden or (not noise and service.name.endswith(NOISE_SERVICES)):
            continue
        facts = (
            ("type", service.type or "unknown"),
            ("served by", service.node),
            ("address", service.uri or "unknown"),
        )
        shape = Shape(Kind.SERVICE, service.name, facts)
        shapes.append(shape)
        lines.append(Line(_node(service.node), shape.key, both=True))
    known = {shape.key for shape in shapes}
    shapes += [
        Shape(Kind.NODE, key.split(" ", 1)[1], reachable=False) for key in sorted(_ends(lines) - known)
    ]
    return Picture(
        tuple(sorted((_with_roles(each, lines) for each in shapes), key=lambda each: each.key)),
        tuple(sorted(lines, key=lambda each: (each.tail, each.head))),
    )


def _with_roles(shape: Shape, lines: Iterable[Line]) -> Shape:
    """Return a node with details about its topics and services; return any other shape unchanged."""
    if shape.kind is not Kind.NODE:
        return shape
    roles = _roles(shape.key, lines)
    facts = [
        (verb, ", ".join(key.split(" ", 1)[1] for role, key in roles if role == verb))
        for verb in ("publishes", "subscribes", "serves")
        if any(role == verb for role, _ in roles)
    ]
    return replace(shape, facts=(*facts, *shape.facts))


def graph_text(snapshot: Snapshot, *, noise: bool = False) -> str:
    """Return a text with the topics and services of each node. The text is the same for equal graphs."""
    shown = picture(snapshot, noise=noise)
    types = {shape.key: dict(shape.facts).get("type", "") for shape in shown.shapes}
    paragraphs = []
    for node in (shape for shape in shown.shapes if shape.kind is Kind.NODE):
        said = [
            f"  {verb:<10} {key.split(' ', 1)[1]}  ({types[key]})"
            for verb, key in _roles(node.key, shown.lines)
        ]
        paragraphs.append("\n".join([node.name, *(said or ["  no topics and no services"])]))
    return "\n".join(paragraphs) or "no nodes"


def _roles(node: str, lines: Iterable[Line]) -> list[tuple[str, str]]:
    roles = []
    for line in lines:
        if line.tail == node:
            roles.append(("serves" if line.both else "publishes", line.head))
        elif line.head == node:
            roles.append(("subscribes", line.tail))
    return sorted(roles)


def _topic_facts(kind: str, publishers: list[str], subscribers: list[str]) -> tuple[tuple[str, str], ...]:
    return (
        ("type", kind or "unknown"),
        ("published by", ", ".join(publishers) or "no node"),
        ("subscribed by", ", ".join(subscribers) or "no node"),
    )


def _node(name: str) -> str:
    return f"{Kind.NODE.value} {name}"


def _ends(lines: Iterable[Line]) -> set[str]:
    return {end for line in lines for end in (line.tail, line.head)}


def folded(picture: Picture, choices: Mapping[str, bool]) -> Picture:
    """Return a copy of the picture: some namespaces are folded boxes, and all others have frames.

    The keys of `choices` are namespaces; the value is True if the reader folded the namespace, and False if
    the reader unfolded it. Other namespaces are folded if the picture has more than `CROWD` shapes. However,
    a namespace with more than half of all shapes is not folded.
    """
    spaces = namespaces(picture)
    crowded = len(picture.shapes) > CROWD
    closed = {
        name
        for name, members in spaces.items()
        if choices.get(name, crowded and 2 * len(members) <= len(picture.shapes))
    }
    # A shape in two folded namespaces belongs to the box of the outer namespace. The names are sorted from
    # long to short. Therefore, the outer namespace replaces the inner namespace in `box`.
    box = {key: name for name in sorted(closed, key=len, reverse=True) for key in spaces[name]}

    def shown(key: str) -> str:
        return f"{Kind.SPACE.value} {box[key]}" if key in box else key

    boxes = {name: space(name, picture, spaces[name]) for name in set(box.values())}
    shapes = [each for each in picture.shapes if each.key not in box] + list(boxes.values())
    frames = [Frame(name, members) for name, members in _open(spaces, closed, shown)]
    return Picture(tuple(sorted(shapes, key=lambda each: each.key)), _lines(picture, shown), tuple(frames))


def namespaces(picture: Picture) -> dict[str, frozenset[str]]:
    """Return the keys of the shapes in each namespace, such as "/turtle1/".

    Only namespaces with at least two shapes are returned.

    If several namespaces have the same shapes, only the innermost of these namespaces is returned.
    """
    found: dict[str, set[str]] = {}
    for shape in picture.shapes:
        parts = shape.name.strip("/").split("/")[:-1]
        for depth in range(len(parts)):
            found.setdefault(f"/{'/'.join(parts[: depth + 1])}/", set()).add(shape.key)
    inner: dict[frozenset[str], str] = {}
    for name in sorted(found, key=len):
        if len(found[name]) > 1:
            inner[frozenset(found[name])] = name
    return {name: members for members, name in sorted(inner.items(), key=lambda each: each[1])}


def space(name: str, picture: Picture, members: frozenset[str]) -> Shape:
    """Return a namespace as one box; its details list the shapes in the namespace."""
    inside = [each for each in picture.shapes if each.key in members]
    kinds = {kind: [each.name for each in inside if each.kind is kind] for kind in PLURALS}
    facts = [("holds", ", ".join(_count(kind, len(names)) for kind, names in kinds.items() if names))]
    # The details of a namespace do not list the topics; activity.py adds the topics with their rates.
    facts += [(PLURALS[kind], ", ".join(kinds[kind])) for kind in (Kind.NODE, Kind.SERVICE) if kinds[kind]]
    if lost := [each.name for each in inside if not each.reachable]:
        facts.append(("does not answer", ", ".join(lost)))
    return Shape(Kind.SPACE, name, tuple(facts), not lost)


def _count(kind: Kind, count: int) -> str:
    return f"{count} {kind.value if count == 1 else PLURALS[kind]}"


def _open(
    spaces: Mapping[str, frozenset[str]], closed: set[str], shown: Callable[[str], str]
) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield the name of each namespace with a frame, and the keys of the visible shapes in it."""
    for name, members in spaces.items():
        if name not in closed and not any(name.startswith(outer) for outer in closed):
            yield name, frozenset(map(shown, members))


def _lines(picture: Picture, shown: Callable[[str], str]) -> tuple[Line, ...]:
    """Return each visible line once; a line inside one folded box is left out."""
    moved = {Line(shown(each.tail), shown(each.head), each.both) for each in picture.lines}
    kept = (each for each in moved if each.tail != each.head)
    return tuple(sorted(kept, key=lambda each: (each.tail, each.head, each.both)))
