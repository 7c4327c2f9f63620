"""A recording of calls, messages and callbacks, as plain data that a program can read without ROS."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

LOOKUP = "lookup"  # The caller requests the address of a service from the master.
CONNECT = "connect"  # The caller connects to the server, and they exchange headers.
REQUEST = "request"
WAIT = "wait"  # The caller waits until the response arrives.
RESPONSE = "response"  # The caller has received the response.
# The call fails. `note` is the error message. `peer` is the server if the server sent this message, and ""
# otherwise.
ERROR = "error"
HANDLER = "handler"
PUBLISH = "publish"
CALLBACK = "callback"
MASTER = "master"  # The peer of a lookup is the master.
GET_RECORD = "getCourseRecord"  # This method of a node's slave API returns a ProcessRecord.
NOBODY = "no subscriber was connected"  # If a message had no subscriber, its event has this note.

OF_CALLS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER)
BLOCKED = (LOOKUP, CONNECT, WAIT)  # During these phases of a call, a node waits for another node.

# The name and the identifier of a thread.
Thread = tuple[str, int]


class SpanData(TypedDict):
    """A span as JSON data; a message in it is [connection, message number, name of the other node]."""

    kind: str
    name: str
    start: float
    end: float | None
    peer: str
    call: int
    transfers: Sequence[tuple[str, int, str]]
    connections: int
    note: str
    thread: Thread


class ProcessRecord(TypedDict):
    """The record of a process, as JSON data.

    `clock` is the time when the record was written, and `process` is the process id. The record contains all
    actions after the time `complete_from`. `unsupported` lists the actions that this process cannot record.
    """

    clock: float
    process: int
    complete_from: float
    unsupported: list[str]
    spans: list[SpanData]


@dataclass(frozen=True)
class Event:
    """One action of a node, such as the lookup of a service.

    `name` is the service or topic, and `peer` is the other node. `start` and `end` are in s since the start
    of the recording; `start` is negative for an earlier event. `end` is None if the event was running at the
    end of the recording. All events of one call have the same `key`; a message and its callbacks also have
    the same `key`. `note` describes how a call failed, or why a message did not reach all subscribers.
    """

    kind: str
    node: str
    name: str
    start: float
    end: float | None
    peer: str = ""
    key: str = ""
    thread: str = ""
    note: str = ""

    @property
    def open(self) -> bool:
        """Whether the event was still running at the end of the recording."""
        return self.end is None


@dataclass
class Recording:
    """The events of all nodes on the graph during a `with` block.

    The recording is empty until the block has ended.

    `events` are sorted by their start. `nodes` are the nodes with a record in this recording. `unrecorded`
    gives the reason for each node without a record. `notes` describes all other missing data. `length` is in
    s, and `node` is the kernel's node.
    """

    node: str = ""
    events: tuple[Event, ...] = ()
    nodes: tuple[str, ...] = ()
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    length: float = 0.0

    def of(self, *kinds: str, name: str = "", node: str = "") -> tuple[Event, ...]:
        """Return the events of these kinds, such as "wait"; without a kind, return the events of all kinds.

        `name` and `node` select the events of one service or topic, and of one node.
        """
        return tuple(
            event
            for event in self.events
            if (not kinds or event.kind in kinds)
            and (not name or event.name == name)
            and (not node or event.node == node)
        )

    def parts(self, key: str) -> tuple[Event, ...]:
        """Return the events of one call, or of one message and its callbacks."""
        return tuple(event for event in self.events if event.key == key)

    def __repr__(self) -> str:
        return f"<recording of {len(self.nodes)} nodes>"
