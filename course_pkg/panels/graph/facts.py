"""What is known of each shape, in words: the details that a click shows, and the list below the drawing."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from course_pkg.errors import InterfaceError
from course_pkg.interfaces import Field, message_type, service_type
from course_pkg.panels.graph.folding import namespaces, space
from course_pkg.panels.graph.picture import Kind, Picture, Shape

State = dict[str, Any]
Pair = tuple[str, str]
Describe = Callable[[Kind, str], list[Pair]]
SHOWN = 12  # fields


def facts(picture: Picture, describe: Describe) -> list[State]:
    """Return an entry for each shape of a picture in which nothing is folded, and for each namespace."""
    spaces = [space(name, picture, members) for name, members in namespaces(picture).items()]
    known: dict[Pair, list[Pair]] = {}
    return [_entry(each, _fields(each, describe, known)) for each in (*picture.shapes, *spaces)]


def fields_of(kind: Kind, name: str) -> list[Pair]:
    """Return the fields of a topic's or service's type in words."""
    try:
        if kind is Kind.TOPIC:
            return [("fields", _words(message_type(name).fields))]
        service = service_type(name)
    except InterfaceError as error:
        return [("fields", str(error).splitlines()[0])]
    return [("request", _words(service.request.fields)), ("response", _words(service.response.fields))]


def _fields(shape: Shape, describe: Describe, known: dict[Pair, list[Pair]]) -> list[Pair]:
    name = dict(shape.facts).get("type", "")
    if "/" not in name:
        return []  # nobody has said it
    what = (shape.kind.value, name)
    if what not in known:
        known[what] = describe(shape.kind, name)
    return known[what]


def _words(fields: Iterable[Field]) -> str:
    said = [f"{each.type} {each.name}" for each in fields]
    more = [f"and {len(said) - SHOWN} more"] if len(said) > SHOWN else []
    return ", ".join(said[:SHOWN] + more) or "none"


def _entry(shape: Shape, fields: list[Pair]) -> State:
    kept = list(shape.facts)
    # A type and what it is made of belong together.
    at = next((number for number, (label, _) in enumerate(kept, start=1) if label == "type"), 0)
    return {
        "key": shape.key,
        "kind": shape.kind.value,
        "name": shape.name,
        "lost": not shape.reachable,
        "facts": [*kept[:at], *fields, *kept[at:]],
    }
