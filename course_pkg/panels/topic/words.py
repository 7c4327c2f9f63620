"""What there is to say about a topic and about what was published, in whole sentences."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from course_pkg.errors import CourseError
from course_pkg.interfaces import MessageType

ANY = "*"
SHORT = 8  # digits of an MD5 that are enough to see that two differ

Find = Callable[[str], MessageType]


def published(spoken: Mapping[str, Any], own: str) -> str:
    """Return what became of the latest message; `own` is the panel's node, which listens, too."""
    count = spoken.get("published", 0)
    if not count:
        return "Nothing is published yet. The first message makes the publisher."
    if not spoken["advertised"]:
        return "The publisher is withdrawn. The next message makes a new one."
    if spoken["rate"]:
        return _rate(spoken)
    peers = [_peer(each["peer"], own) for each in spoken["deliveries"]]
    if spoken["reached"]:
        same = len(peers) == spoken["reached"]
        return f"Message {count} went to {_all(peers) if same else _count(spoken['reached'], 'subscriber')}."
    if not spoken["latch"]:
        return f"Message {count} went to nobody: no subscriber was connected when it was published."
    if peers:
        return f"Message {count} was kept, and went to {_all(peers)} as soon as it was connected."
    return f"Message {count} went to nobody yet. Latched, it is kept for the next subscriber that connects."


def _rate(spoken: Mapping[str, Any]) -> str:
    real = spoken["pace"].get("rate")
    kept = f", really {real:.4g} Hz" if real else ""
    skipped = f" {_count(spoken['skipped'], 'message')} had to be left out." if spoken["skipped"] else ""
    return f"Publishing at {spoken['rate']:g} Hz{kept}.{skipped}"


def mismatches(kind: MessageType, around: Mapping[str, Any], own: str, find: Find) -> list[str]:
    """Return a sentence for each node on the topic whose type is not `kind`; rospy itself says nothing.

    `around` is a Neighbourhood as plain data with the `sources`, the publishers that are connected here.
    """
    sources = {source["node"]: source for source in around.get("sources", ())}
    return [
        *_of_publishers(kind, around.get("publishers", ()), sources, own, find),
        *_of_subscribers(kind, around.get("subscribers", ()), own, find),
    ]


def _of_publishers(
    kind: MessageType,
    publishers: Iterable[Mapping[str, str]],
    sources: Mapping[str, Any],
    own: str,
    find: Find,
) -> Iterator[str]:
    for each in publishers:
        node, source = each["node"], sources.get(each["node"])
        name = source["type"] if source else each["type"]
        md5 = source["md5"] if source else _md5(name, find)
        if node != own and _differs(kind, name, md5):
            yield (
                f"{node} publishes {_type(name, md5)}, this panel has {_type(kind.name, kind.md5)}. "
                "A subscriber of the panel's type hears nothing of it, and no error either."
            )


def _of_subscribers(
    kind: MessageType, subscribers: Iterable[Mapping[str, str]], own: str, find: Find
) -> Iterator[str]:
    for each in subscribers:
        node, name = each["node"], each["type"]
        md5 = _md5(name, find)
        if node != own and _differs(kind, name, md5):
            yield (
                f"{node} subscribes to {_type(name, md5)}, this panel has {_type(kind.name, kind.md5)}. "
                "It hears nothing that is published with the panel's type, and is not told."
            )


def _differs(kind: MessageType, name: str, md5: str) -> bool:
    if not name or name == ANY:
        return False
    return md5 != kind.md5 if md5 else name != kind.name


def _md5(name: str, find: Find) -> str:
    """Return the MD5 of a type by name, "" where it is not known here."""
    try:
        return find(name).md5 if name and name != ANY else ""
    except CourseError:
        return ""


def _type(name: str, md5: str) -> str:
    return f"{name} (MD5 {md5[:SHORT]}…)" if md5 else name


def _peer(node: str, own: str) -> str:
    return "this panel" if node == own else node


def _all(names: list[str]) -> str:
    """Return "a, b and c"."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def _count(number: int, what: str) -> str:
    return f"1 {what}" if number == 1 else f"{number} {what}s"
