"""A recording of what nodes did, as plain data: no ROS is needed to read one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

LOOKUP = "lookup"  # the caller asks the master for the address of a service
CONNECT = "connect"  # the caller connects to the server, and both exchange headers
REQUEST = "request"  # the caller sends the request
WAIT = "wait"  # the caller is blocked until the response arrives
RESPONSE = "response"  # the moment when the caller has the response
ERROR = "error"  # the moment when the call fails; `note` is the error, `peer` the server if it sent the error
HANDLER = "handler"  # the server handles a request
PUBLISH = "publish"  # a message is published
CALLBACK = "callback"  # a subscriber's callback runs
MASTER = "master"  # the peer of a lookup
GET_RECORD = "getCourseRecord"  # the method of a node's slave API that returns a ProcessRecord
NOBODY = "nobody was connected"  # the note of a message that had no subscriber

OF_CALLS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER)
BLOCKED = (LOOKUP, CONNECT, WAIT)  # in these parts, a node waits for another one

Thread = tuple[str, int]  # its name, and its identifier while it runs


class SpanData(TypedDict):
    """A span as JSON data; a transfer is [connection, number, node at the other end]."""

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
    """What a process has recorded, as JSON data.

    `clock` is the time when it was written, `process` the process id. From `complete_from` on, nothing is
    missing. `unsupported` lists what this process cannot record.
    """

    clock: float
    process: int
    complete_from: float
    unsupported: list[str]
    spans: list[SpanData]


@dataclass(frozen=True)
class Event:
    """One thing that a node did. `name` is the service or topic, `peer` the other node.

    `start` and `end` are seconds from the start of the recording. `start` is negative for an event that began
    before it, `end` is None for an event that had not ended when it ended. `key` is the same for the parts of
    one call, and for a message and its callbacks. `note` describes how a call failed, or why a message did
    not reach all subscribers.
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
        """Whether it was still going on when the recording ended."""
        return self.end is None


@dataclass
class Recording:
    """What the nodes on the graph did during a block; empty until the block has ended.

    `events` are sorted by their start, `nodes` are those that kept a record, and `unrecorded` gives the
    reason for each node that kept none. `notes` are sentences about anything else that is missing.
    `length` is in seconds, `node` is the kernel's node.
    """

    node: str = ""
    events: tuple[Event, ...] = ()
    nodes: tuple[str, ...] = ()
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    length: float = 0.0

    def of(self, *kinds: str, name: str = "", node: str = "") -> tuple[Event, ...]:
        """Return the events of these kinds, such as "wait", or of all kinds; of one name or node if given."""
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
