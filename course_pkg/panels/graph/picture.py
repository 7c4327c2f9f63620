"""A look at the graph as shapes and lines, before anyone has said where they go."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from course_pkg.graph import Snapshot


NOISE_NODES = frozenset({"/rosout"})
NOISE_TOPICS = frozenset({"/rosout", "/rosout_agg"})
NOISE_SERVICES = ("/get_loggers", "/set_logger_level")


class Kind(str, Enum):
    """What a shape stands for."""

    NODE = "node"
    TOPIC = "topic"
    SERVICE = "service"
    SPACE = "namespace"  # folded into one box


@dataclass(frozen=True)
class Shape:
    """One node, topic, service or folded namespace; `facts` are pairs of label and value for its details."""

    kind: Kind
    name: str
    facts: tuple[tuple[str, str], ...] = ()
    reachable: bool = True

    @property
    def key(self) -> str:
        """What tells it from all others: a topic and a service may have one name."""
        return f"{self.kind.value} {self.name}"


@dataclass(frozen=True)
class Line:
    """A way that data goes between two shapes, by their keys; a service's goes both ways."""

    tail: str
    head: str
    both: bool = False


@dataclass(frozen=True)
class Frame:
    """A namespace that is not folded, such as "/turtle1/"; `members` are the keys of all shapes in it."""

    name: str
    members: frozenset[str]

    @property
    def key(self) -> str:
        """The same key that the namespace has as one box."""
        return f"{Kind.SPACE.value} {self.name}"


@dataclass(frozen=True)
class Picture:
    """All shapes, lines and frames, in an order that depends on names only; an outer frame comes first."""

    shapes: tuple[Shape, ...] = ()
    lines: tuple[Line, ...] = ()
    frames: tuple[Frame, ...] = ()


def picture(snapshot: Snapshot, *, noise: bool = False, hide: Iterable[str] = ()) -> Picture:
    """Return the shapes and lines of a snapshot.

    Without `noise`, /rosout and the logger services that every node brings are left out. `hide` names
    nodes to leave out, together with their services and the topics that only they use.
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
        tuple(sorted((_with_deeds(each, lines) for each in shapes), key=lambda each: each.key)),
        tuple(sorted(lines, key=lambda each: (each.tail, each.head))),
    )


def _with_deeds(shape: Shape, lines: Iterable[Line]) -> Shape:
    """Return a node with what it publishes, subscribes and serves among its facts; others as they are."""
    if shape.kind is not Kind.NODE:
        return shape
    deeds = _deeds(shape.key, lines)
    facts = [
        (verb, ", ".join(key.split(" ", 1)[1] for done, key in deeds if done == verb))
        for verb in ("publishes", "subscribes", "serves")
        if any(done == verb for done, _ in deeds)
    ]
    return replace(shape, facts=(*facts, *shape.facts))


def graph_text(snapshot: Snapshot, *, noise: bool = False) -> str:
    """Return the graph in words, the same for the same graph: who publishes, subscribes, serves what."""
    shown = picture(snapshot, noise=noise)
    types = {shape.key: dict(shape.facts).get("type", "") for shape in shown.shapes}
    paragraphs = []
    for node in (shape for shape in shown.shapes if shape.kind is Kind.NODE):
        said = [
            f"  {verb:<10} {key.split(' ', 1)[1]}  ({types[key]})"
            for verb, key in _deeds(node.key, shown.lines)
        ]
        paragraphs.append("\n".join([node.name, *(said or ["  on its own"])]))
    return "\n".join(paragraphs) or "no nodes"


def _deeds(node: str, lines: Iterable[Line]) -> list[tuple[str, str]]:
    deeds = []
    for line in lines:
        if line.tail == node:
            deeds.append(("serves" if line.both else "publishes", line.head))
        elif line.head == node:
            deeds.append(("subscribes", line.tail))
    return sorted(deeds)


def _topic_facts(kind: str, publishers: list[str], subscribers: list[str]) -> tuple[tuple[str, str], ...]:
    return (
        ("type", kind or "unknown"),
        ("published by", ", ".join(publishers) or "nobody"),
        ("subscribed by", ", ".join(subscribers) or "nobody"),
    )


def _node(name: str) -> str:
    return f"{Kind.NODE.value} {name}"


def _ends(lines: Iterable[Line]) -> set[str]:
    return {end for line in lines for end in (line.tail, line.head)}
