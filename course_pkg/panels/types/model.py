"""What a type browser knows, with no page, no kernel and no ROS: which types there are, and which is open."""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from course_pkg.interfaces import Half, list_message_types, list_service_types
from course_pkg.panels.types.description import State, described

if TYPE_CHECKING:
    from course_pkg.graph import Snapshot

Catalogue = tuple[tuple[str, ...], tuple[str, ...]]  # service types, message types


def catalogue() -> Catalogue:
    """Return the names of all service and message types on ROS_PACKAGE_PATH."""
    return tuple(list_service_types()), tuple(list_message_types())


class TypeModel:
    """Lists types, shows one, and says who offers it now.

    `changed` hears by keyword of `packages` (the types of each, by half), `described` (the open type, see
    there), and `offers` (who has which type on the graph now, by half and type).
    """

    def __init__(
        self,
        changed: Callable[..., None],
        *,
        describe: Callable[[str, Half], State] = described,
        turn: threading.RLock | None = None,
    ) -> None:
        self._changed = changed
        self._describe = describe
        self._turn = turn or threading.RLock()
        self._known: Catalogue = ((), ())
        self._open: tuple[str, Half] | None = None
        self._described: State = {}

    def know(self, known: Catalogue) -> None:
        """Take in which types there are now; the open one is read again, since its file may have changed."""
        with self._turn:
            if known != self._known:
                self._known = known
                self._changed(packages=packages(known))
            self._show()

    def open(self, name: str, half: Half | None = None) -> None:
        """Show a type; without `half` a service type, or else a message type of this name."""
        with self._turn:
            self._open = (name, half or self._half(name))
            self._show()

    @property
    def file(self) -> str:
        """The file of the open type, "" if it has none or no type is open."""
        return str(self._described.get("file", ""))

    def see(self, snapshot: Snapshot) -> None:
        """Take in who is on the graph now."""
        with self._turn:
            self._changed(offers=offers(snapshot))

    def _half(self, name: str) -> Half:
        services, messages = self._known
        return "msg" if name in messages and name not in services else "srv"

    def _show(self) -> None:
        if self._open is None:
            return
        now = self._describe(*self._open)
        if now != self._described:
            self._described = now
            self._changed(described=now)


def packages(known: Catalogue) -> list[State]:
    """Return the packages that have types, sorted, each with the short names of its types."""
    found: dict[str, dict[str, list[str]]] = defaultdict(lambda: {"srv": [], "msg": []})
    for half, names in zip(("srv", "msg"), known, strict=True):
        for name in names:
            package, _, short = name.partition("/")
            found[package][half].append(short)
    return [{"name": package, **found[package]} for package in sorted(found)]


def offers(snapshot: Snapshot) -> State:
    """Return who has which type now: for a service type its services, for a message type its topics."""
    services: dict[str, list[Any]] = defaultdict(list)
    topics: dict[str, list[Any]] = defaultdict(list)
    for service in snapshot.services:
        services[service.type].append({"name": service.name, "served by": [service.node]})
    for topic in snapshot.topics:
        ends = {"published by": list(topic.publishers), "subscribed by": list(topic.subscribers)}
        topics[topic.type].append({"name": topic.name, **ends})
    return {"srv": {k: v for k, v in services.items() if k}, "msg": {k: v for k, v in topics.items() if k}}
