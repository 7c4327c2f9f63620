"""What the wire view shows, as plain data: the steps of a call, each with the pieces of its bytes.

It needs no master and no page: its input is what ros/wire/capture.py recorded.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, TypedDict

from course_pkg.errors import CourseError
from course_pkg.panels.wire.anatomy import (
    Frame,
    Pieces,
    header_pieces,
    header_values,
    replies,
    reply_pieces,
    request_pieces,
    requests,
    the_header,
)
from course_pkg.panels.wire.pieces import shortened
from course_pkg.types import MessageType, ServiceType, service_type

if TYPE_CHECKING:
    from course_pkg.ros.wire.capture import Wire
    from course_pkg.ros.wire.relay import RelayedConnection

STEPS = 60  # of a capture of many calls
XML = 900  # characters of a request to the master, or of its response

FindType = Callable[[str], ServiceType]

_Ends = TypedDict("_Ends", {"from": str, "to": str})


class Step(_Ends):
    """A step of a call, `ms` after the first; `says` explains it, `bad` marks an error.

    `pieces` are those of its `size` bytes; the look-up has a `text` instead. `connection` is 0 if there is
    only one.
    """

    title: str
    ms: float
    says: str
    size: int
    pieces: Pieces
    text: str
    bad: bool
    connection: int


class WireState(TypedDict):
    """A captured call for the page, with the names of client, server and master; `outcome` is its error."""

    service: str
    names: dict[str, str]
    steps: list[Step]
    outcome: str
    notes: list[str]


def state(wire: Wire, find: FindType = service_type) -> WireState:
    """Return what the page needs of a capture.

    `find` returns the type of a name, for connections whose type only their headers tell.
    """
    start = min((each.opened for each in _all(wire)), default=0.0)
    steps = list(_look_up(wire, start))
    for number, connection in enumerate(wire.connections, start=1):
        of_several = number if len(wire.connections) > 1 else 0
        steps += _ConnectionSteps(connection, of_several, wire, start, find).steps()
    return {
        "service": wire.service,
        "names": _names(wire),
        "steps": steps[:STEPS],
        "outcome": shortened(wire.error, 400),
        "notes": list(_notes(wire, len(steps))),
    }


def _all(wire: Wire) -> list[RelayedConnection]:
    return [*([wire.lookup] if wire.lookup else []), *wire.connections]


def _names(wire: Wire) -> dict[str, str]:
    """Return the names of both ends, as their first connection headers have them."""
    names = {"client": "the client", "server": "the server", "master": "master"}
    for connection in reversed(wire.connections):
        for end, by_client in (("client", True), ("server", False)):
            said = header_values(connection.data(from_client=by_client)).get("callerid")
            names[end] = said or names[end]
    return names


def _notes(wire: Wire, steps: int) -> Iterator[str]:
    if steps > STEPS:
        yield f"Shown are the first {STEPS} of {steps} steps."
    if wire.skipped:
        yield f"{wire.skipped} more connections were passed on and not taken down."
    if lost := sum(each.lost for each in _all(wire)):
        yield f"{lost:,} bytes more were passed on and not taken down."


def _step(
    title: str,
    source: str,
    to: str,
    seconds: float,
    says: str,
    *,
    size: int = 0,
    pieces: Pieces | None = None,
    text: str = "",
    bad: bool = False,
    connection: int = 0,
) -> Step:
    return {
        "title": title,
        "from": source,
        "to": to,
        "ms": round(seconds * 1000, 3),
        "says": says,
        "size": size,
        "pieces": pieces or [],
        "text": text,
        "bad": bad,
        "connection": connection,
    }


def _look_up(wire: Wire, start: float) -> Iterator[Step]:
    connection = wire.lookup
    if connection is None:
        return
    asked, answered = connection.data(from_client=True), connection.data(from_client=False)
    offset = connection.opened - start
    yield _step(
        f"Look-up: where is {wire.service}?",
        "client",
        "master",
        offset + connection.since(0, from_client=True),
        says="XML-RPC: a method and its arguments as XML, sent by HTTP. Only the look-up goes to the master.",
        size=len(asked),
        text=_xml(asked),
    )
    there = bool(wire.uri)
    yield _step(
        f"It is at {wire.uri}" if there else "Nobody serves it",
        "master",
        "client",
        offset + connection.since(0, from_client=False),
        says=(
            "The address of the server, and nothing else: from here on the master has no part in the call."
            if there
            else "The code -1 says that the look-up failed. There is no address, so nothing more is sent."
        ),
        size=len(answered),
        text=_xml(answered),
        bad=not there,
    )


def _xml(http: bytes) -> str:
    """Return the body of an exchange by HTTP, a line for each value."""
    body = http.partition(b"\r\n\r\n")[2].decode("utf-8", "replace")
    return shortened(re.sub(r"\s*\n\s*", "", body).replace("><", ">\n<"), XML)


class _ConnectionSteps:
    """One connection, as steps."""

    def __init__(
        self, connection: RelayedConnection, number: int, wire: Wire, start: float, find: FindType
    ) -> None:
        self._connection = connection
        self._number = number
        self._wire = wire
        self._offset = connection.opened - start
        self._find = find
        self._sent = connection.data(from_client=True)
        self._came = connection.data(from_client=False)
        self._asked, self._answered = header_values(self._sent), header_values(self._came)

    def steps(self) -> list[Step]:
        """Return all of them, in order."""
        return [*self._opening(), *self._headers(), *self._calls(), *self._ending()]

    def _at(
        self,
        title: str,
        by_client: bool,
        at: int,
        says: str,
        *,
        size: int = 0,
        pieces: Pieces | None = None,
        bad: bool = False,
    ) -> Step:
        ends = ("client", "server") if by_client else ("server", "client")
        seconds = self._offset + self._connection.since(at, from_client=by_client)
        return _step(title, *ends, seconds, says, size=size, pieces=pieces, bad=bad, connection=self._number)

    def _opening(self) -> Iterator[Step]:
        where = self._wire.uri.rpartition("/")[2] or "the server"
        refused = self._connection.refused
        title = f"Nobody takes the connection at {where}" if refused else f"Connects to {where}"
        says = (
            f"{refused}. Somebody was there once, and the master still has the address."
            if refused
            else "A TCP connection, straight to the server. It carries no byte yet that a program wrote."
        )
        yield _step(
            title, "client", "server", self._offset, says=says, bad=bool(refused), connection=self._number
        )

    def _headers(self) -> Iterator[Step]:
        if sent := the_header(self._sent):
            probe = self._asked.get("probe") == "1"
            title = "Connection header of the client" + (", which only asks" if probe else "")
            yield self._framed(title, True, sent, header_pieces(sent.data), says=self._greeting(probe))
        if came := the_header(self._came):
            refused = "error" in self._answered
            title = "The server refuses the connection" if refused else "Connection header of the server"
            says = (
                "A header with one field, error: the reason as text. Then the server closes the "
                "connection, and the client sends no request."
                if refused
                else "Who answers, and of which type the service is. The MD5 is the same: a request may come."
            )
            yield self._framed(title, False, came, header_pieces(came.data), says=says, bad=refused)

    def _greeting(self, probe: bool) -> str:
        if probe:
            return "probe=1: no request will follow. So wait_for_service asks whether somebody is there."
        return (
            f"{len(self._asked)} fields in any order, each with its length in front. The MD5 says which "
            "definition the client was built with."
        )

    def _calls(self) -> Iterator[Step]:
        if self._asked.get("probe") == "1" or "error" in self._answered:
            return
        kind = self._kind()
        came = replies(self._came)
        for sent in requests(self._sent):
            yield self._framed(
                "Request",
                True,
                sent,
                request_pieces(sent.data, kind.request if kind else None),
                says=_of_body(kind.request if kind else None),
            )
            if (reply := next(came, None)) is not None:
                yield self._reply(reply, kind)

    def _reply(self, reply: Frame, kind: ServiceType | None) -> Step:
        worked = reply.data[:1] == b"\1"
        says = (
            f"One byte says that it worked. {_of_body(kind.response if kind else None)}"
            if worked
            else "The byte is 0, so what follows is no response: it is the reason, as text."
        )
        pieces = reply_pieces(reply.data, kind.response if kind else None)
        return self._framed(
            "Response" if worked else "Error", False, reply, pieces, says=says, bad=not worked
        )

    def _framed(
        self, title: str, by_client: bool, frame: Frame, pieces: Pieces, says: str, bad: bool = False
    ) -> Step:
        return self._at(title, by_client, frame.at, says, size=len(frame.data), pieces=pieces, bad=bad)

    def _ending(self) -> Iterator[Step]:
        if not self._connection.closed_by:
            return
        by_client = self._connection.closed_by == "client"
        lost = self._unanswered()
        title = "The connection is closed"
        if lost:
            title = "The client gives up" if by_client else "The server closes without a response"
        says = self._ending_says(lost)
        yield self._at(title, by_client or not lost, 1 << 62, says, bad=lost)

    def _ending_says(self, lost: bool) -> str:
        if lost and not self._came:
            return "Not one byte came back. Somebody took the connection, and did not speak."
        if lost:
            return "An answer was due. What the server did of its work until then, nobody can tell from here."
        if "error" in self._answered:
            return "No request was sent, so no handler ran."
        if self._asked.get("probe") == "1":
            return "That was the whole question: somebody is there, and speaks."
        if self._asked.get("persistent") in ("1", "true"):
            return "The client had asked for persistent=1, so the connection served for more than one call."
        return "One connection, one call. The next call begins with a look-up again."

    def _unanswered(self) -> bool:
        if self._sent and not self._came:
            return True
        if self._asked.get("probe") == "1" or "error" in self._answered:
            return False
        return len(list(requests(self._sent))) > len(list(replies(self._came)))

    def _kind(self) -> ServiceType | None:
        name = self._answered.get("type", "")
        kind = self._wire.kind
        if kind is None or kind.name != name:
            try:
                kind = self._find(name)
            except CourseError:
                return None
        return kind if kind.md5 == self._answered.get("md5sum") else None


def _of_body(kind: MessageType | None) -> str:
    if kind is None:
        return "The fields of a type that is not known here."
    if not kind.fields:
        return "The type has no fields here, so the length is 0 and nothing follows."
    return "The fields one after the other, in the order of the definition, without names: hence the MD5."
