"""The steps of one connection between a client and a server, each with the pieces of its bytes."""

from __future__ import annotations

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
from course_pkg.types import MessageType, ServiceType

if TYPE_CHECKING:
    from course_pkg.ros.wire.capture import Wire
    from course_pkg.ros.wire.relay import RelayedConnection

FindType = Callable[[str], ServiceType]

_Ends = TypedDict("_Ends", {"from": str, "to": str})


class Step(_Ends):
    """One step of a call, such as the connection or the request.

    `ms` is the time in ms since the first step. `says` explains the step. `bad` is True if the step is an
    error.

    `size` is the number of bytes of the step, and `pieces` describes these bytes. Requests to the master and
    its responses have `text` instead of `pieces`. `connection` is the number of the connection, or 0 if the
    call has only one connection.
    """

    title: str
    ms: float
    says: str
    size: int
    pieces: Pieces
    text: str
    bad: bool
    connection: int


def new_step(
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
    """Return a new step; `seconds` is the time after the first step."""
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


class ConnectionSteps:
    """Collects the steps of one connection."""

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
        """Return all steps of the connection, in order."""
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
        return new_step(
            title, *ends, seconds, says, size=size, pieces=pieces, bad=bad, connection=self._number
        )

    def _opening(self) -> Iterator[Step]:
        where = self._wire.uri.rpartition("/")[2] or "the server"
        refused = self._connection.refused
        title = f"No process accepts the connection at {where}" if refused else f"Connects to {where}"
        says = (
            f"{refused}. A server used this address earlier, and the master still stores this address."
            if refused
            else "This is a TCP connection, directly to the server. No program has sent a byte yet."
        )
        yield new_step(
            title, "client", "server", self._offset, says=says, bad=bool(refused), connection=self._number
        )

    def _headers(self) -> Iterator[Step]:
        if sent := the_header(self._sent):
            probe = self._asked.get("probe") == "1"
            title = "Connection header of the client" + (" (only a probe)" if probe else "")
            yield self._framed(title, True, sent, header_pieces(sent.data), says=self._greeting(probe))
        if came := the_header(self._came):
            refused = "error" in self._answered
            title = "The server refuses the connection" if refused else "Connection header of the server"
            says = (
                "The header has one field with the name `error`, which contains the reason. "
                "Then the server closes the connection, and the client sends no request."
                if refused
                else "The header contains the name of the server's node and the type of the service. "
                "The MD5 sums are equal, so a request can follow."
            )
            yield self._framed(title, False, came, header_pieces(came.data), says=says, bad=refused)

    def _greeting(self, probe: bool) -> str:
        if probe:
            return "probe=1 means that no request follows. wait_for_service uses probe=1 to find a server."
        return (
            f"The header has {len(self._asked)} fields in any order. The length of each field "
            "comes before the field. The MD5 sum identifies the definition that the client was "
            "built with."
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
            f"The first byte means that the call worked. {_of_body(kind.response if kind else None)}"
            if worked
            else (
                "The first byte is 0, which means that the call failed. After this byte, the reason follows "
                "as text."
            )
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
            return "The client received no byte. A process accepted the connection, but sent nothing."
        if lost:
            return (
                "The client received no response, so the client cannot know how much work the "
                "server has done."
            )
        if "error" in self._answered:
            return "No request was sent, so no handler ran."
        if self._asked.get("probe") == "1":
            return "The probe was successful: a server answers at this address."
        if self._asked.get("persistent") in ("1", "true"):
            return "The client had set persistent=1, so it could use the connection for several calls."
        return "The client used the connection for one call. The next call begins with a new look-up."

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
        return "These fields belong to a type that is not installed on this computer."
    if not kind.fields:
        return "This part of the type has no fields, so the length is 0 and nothing follows."
    return (
        "The fields follow in the order of the definition, without names. Therefore, client and server "
        "must have the same MD5."
    )
