"""A recording of what nodes did, as plain data: a program can read it without ROS."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

LOOKUP = "lookup"  # the caller asks the master for the address of a service
CONNECT = "connect"  # the caller connects to the server, and both exchange headers
REQUEST = "request"  # the caller sends the request
WAIT = "wait"  # the caller is blocked until the response arrives
RESPONSE = "response"  # the moment when the caller has the response
# the moment when the call fails; `note` is the error message, and `peer` is its sender, if any
ERROR = "error"
HANDLER = "handler"  # the server handles a request
PUBLISH = "publish"  # a message is published
CALLBACK = "callback"  # a subscriber's callback runs
MASTER = "master"  # the peer of a lookup
GET_RECORD = "getCourseRecord"  # the method of a node's slave API that returns a ProcessRecord
NOBODY = "nobody was connected"  # the note of a message that had no subscriber

OF_CALLS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER)
BLOCKED = (LOOKUP, CONNECT, WAIT)  # the parts of a call in which a node waits for another node

Thread = tuple[str, int]  # the name and the identifier of a thread; a later thread may reuse the identifier


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
    """The record of a process, as JSON data.

    `clock` is the time when the record was written, and `process` is the process id. The record is complete
    after the time `complete_from`. `unsupported` lists what this process cannot record.
    """

    clock: float
    process: int
    complete_from: float
    unsupported: list[str]
    spans: list[SpanData]


@dataclass(frozen=True)
class Event:
    """One action of a node. `name` is the service or topic, and `peer` is the other node.

    `start` and `end` are in s since the start of the recording. `start` is negative if the event began before
    the recording. `end` is None if the event had not ended when the recording ended. `key` is the same for
    all parts of one call, and for a message and its callbacks. `note` describes how a call failed, or why a
    message did not reach all subscribers.
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
        """Whether the event had not ended when the recording ended."""
        return self.end is None


@dataclass
class Recording:
    """The events of all nodes on the graph during a block; the recording is empty until the block has ended.

    `events` are sorted by their start. `nodes` are the nodes with a record. `unrecorded` gives the reason for
    each node without a record. `notes` contains sentences about all other missing data. `length` is in s, and
    `node` is the kernel's node.
    """

    node: str = ""
    events: tuple[Event, ...] = ()
    nodes: tuple[str, ...] = ()
    unrecorded: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    length: float = 0.0

    def of(self, *kinds: str, name: str = "", node: str = "") -> tuple[Event, ...]:
        """Return the events of these kinds, such as "wait"; if no kind is given, return events of all kinds.

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
