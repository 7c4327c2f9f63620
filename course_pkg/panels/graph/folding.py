"""Namespaces of a picture, each drawn as a frame around what is in it, or folded into one box."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from course_pkg.panels.graph.picture import Frame, Kind, Line, Picture, Shape

CROWD = 30  # shapes; with more than that, namespaces fold by themselves
PLURALS = {Kind.NODE: "nodes", Kind.TOPIC: "topics", Kind.SERVICE: "services"}


def folded(picture: Picture, choices: Mapping[str, bool]) -> Picture:
    """Return the picture with namespaces folded, and frames around the others.

    `choices` says of a namespace whether somebody wants it folded. Without a choice it is folded in a
    picture of more than `CROWD` shapes, unless that would leave next to nothing of the picture.
    """
    spaces = namespaces(picture)
    crowded = len(picture.shapes) > CROWD
    shut = {
        name
        for name, members in spaces.items()
        if choices.get(name, crowded and 2 * len(members) <= len(picture.shapes))
    }
    # The shortest name comes first: what is in two folded namespaces is in the box of the outer one.
    box = {key: name for name in sorted(shut, key=len, reverse=True) for key in spaces[name]}

    def shown(key: str) -> str:
        return f"{Kind.SPACE.value} {box[key]}" if key in box else key

    boxes = {name: space(name, picture, spaces[name]) for name in set(box.values())}
    shapes = [each for each in picture.shapes if each.key not in box] + list(boxes.values())
    frames = [Frame(name, members) for name, members in _open(spaces, shut, shown)]
    return Picture(tuple(sorted(shapes, key=lambda each: each.key)), _lines(picture, shown), tuple(frames))


def namespaces(picture: Picture) -> dict[str, frozenset[str]]:
    """Return the keys of the shapes in each namespace that holds two or more, such as "/turtle1/".

    Of several that hold the same shapes only the innermost counts.
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
    """Return a namespace as one box; its facts say what is in it."""
    inside = [each for each in picture.shapes if each.key in members]
    kinds = {kind: [each.name for each in inside if each.kind is kind] for kind in PLURALS}
    facts = [("holds", ", ".join(_count(kind, len(names)) for kind, names in kinds.items() if names))]
    # Its topics are told with their rates.
    facts += [(PLURALS[kind], ", ".join(kinds[kind])) for kind in (Kind.NODE, Kind.SERVICE) if kinds[kind]]
    if lost := [each.name for each in inside if not each.reachable]:
        facts.append(("does not answer", ", ".join(lost)))
    return Shape(Kind.SPACE, name, tuple(facts), not lost)


def _count(kind: Kind, count: int) -> str:
    return f"{count} {kind.value if count == 1 else PLURALS[kind]}"


def _open(
    spaces: Mapping[str, frozenset[str]], shut: set[str], shown: Callable[[str], str]
) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield the namespaces to be framed, with the shapes in each as they are shown."""
    for name, members in spaces.items():
        if name not in shut and not any(name.startswith(outer) for outer in shut):
            yield name, frozenset(map(shown, members))


def _lines(picture: Picture, shown: Callable[[str], str]) -> tuple[Line, ...]:
    """Return each line between what is shown once; what runs inside of one box is not seen."""
    moved = {Line(shown(each.tail), shown(each.head), each.both) for each in picture.lines}
    kept = (each for each in moved if each.tail != each.head)
    return tuple(sorted(kept, key=lambda each: (each.tail, each.head, each.both)))
