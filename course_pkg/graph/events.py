"""What a recording consists of, as plain data: no ROS is needed to read one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

LOOKUP = "lookup"  # the caller asks the master for the address of a service
CONNECT = "connect"  # the caller connects to the server, and both say who they are
REQUEST = "request"  # the caller sends the request
WAIT = "wait"  # the caller is blocked until the response is there
RESPONSE = "response"  # the moment in which the caller has the response
ERROR = "error"  # the moment in which the call fails; `note` says how, `peer` is the server if it said so
HANDLER = "handler"  # the server works on a request
PUBLISH = "publish"  # a message is published
CALLBACK = "callback"  # a subscriber's callback runs
MASTER = "master"  # the peer of a look-up
NOBODY = "nobody was connected"  # the note of a message that was lost so

OF_CALLS = (LOOKUP, CONNECT, REQUEST, WAIT, RESPONSE, ERROR, HANDLER)
OF_MESSAGES = (PUBLISH, CALLBACK)
BLOCKED = (LOOKUP, CONNECT, WAIT)  # in these, a node waits for another


@dataclass(frozen=True)
class Event:
    """One thing that a node did. `name` is the service or topic, `peer` the other node.

    `start` and `end` are s from the start of the recording: `start` is negative for what was going on before,
    `end` is None for what had not ended with it. `key` is the same for the parts of one call, and for a
    message and the callbacks that got it. `note` says in words how a call failed, or where a message did not
    go.
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

    def as_dict(self) -> dict[str, Any]:
        """Return it as plain data, fit for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Event:
        """Return the event that as_dict() has made plain data of."""
        return cls(**data)
