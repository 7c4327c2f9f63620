"""A recording of what nodes did, as plain data: no ROS is needed to read one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from course_pkg.graph.events import Event


@dataclass
class Recording:
    """What the nodes on the graph did during a block; empty until the block has ended.

    `events` are sorted by their start, `nodes` are those that kept a record, and `unrecorded` says of each
    other node why it has none. `notes` are sentences about what is missing besides. `length` is in s, `node`
    is the kernel's own.
    """

    node: str = ""
    events: tuple[Event, ...] = ()
    nodes: tuple[str, ...] = ()
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    length: float = 0.0

    def of(self, *kinds: str, name: str = "", node: str = "") -> tuple[Event, ...]:
        """Return the events of these kinds, such as "wait", or of all; of one name or node if given."""
        return tuple(
            event
            for event in self.events
            if (not kinds or event.kind in kinds)
            and (not name or event.name == name)
            and (not node or event.node == node)
        )

    def parts(self, key: str) -> tuple[Event, ...]:
        """Return what belongs to one call, or to one message and its callbacks."""
        return tuple(event for event in self.events if event.key == key)

    def as_dict(self) -> dict[str, Any]:
        """Return it as plain data, fit for JSON."""
        return {
            "node": self.node,
            "events": [event.as_dict() for event in self.events],
            "nodes": list(self.nodes),
            "unrecorded": dict(self.unrecorded),
            "notes": list(self.notes),
            "length": self.length,
        }

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Recording:
        """Return the recording that as_dict() has made plain data of."""
        return cls(
            node=data["node"],
            events=tuple(Event.from_dict(event) for event in data["events"]),
            nodes=tuple(data["nodes"]),
            unrecorded=dict(data["unrecorded"]),
            notes=tuple(data["notes"]),
            length=data["length"],
        )

    def __repr__(self) -> str:
        return f"<recording of {len(self.nodes)} nodes>"
