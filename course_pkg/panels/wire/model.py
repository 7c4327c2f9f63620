"""What the wire view shows, as plain data: the steps of a call, each with the pieces of its bytes.

Knows no master and no page; it takes what graph/wiretap.py took down.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from course_pkg.errors import CourseError
from course_pkg.interfaces import MessageType, ServiceType, service_type
from course_pkg.panels.wire.anatomy import Pieces, header_pieces, reply_pieces, request_pieces
from course_pkg.panels.wire.frames import Frame, replies, requests, said_first, the_header
from course_pkg.panels.wire.pieces import shortened

if TYPE_CHECKING:
    from course_pkg.graph.relay import Conversation
    from course_pkg.graph.wiretap import Wire

STEPS = 60  # of a tap that many calls went through
XML = 900  # characters of what the master is asked and answers

State = dict[str, Any]
Step = dict[str, Any]
Find = Callable[[str], ServiceType]


def state(wire: Wire, find: Find = service_type) -> State:
    """Return all that the page needs; times are in ms from the first thing that happened.

    `find` returns the type of a name, for connections whose type only their headers tell.
    """
    begun = min((each.opened for each in _all(wire)), default=0.0)
    steps = list(_look_up(wire, begun))
    for number, conversation in enumerate(wire.conversations, start=1):
        of_several = number if len(wire.conversations) > 1 else 0
        steps += _Spoken(conversation, of_several, wire, begun, find).steps()
    return {
        "service": wire.service,
        "names": _names(wire),
        "steps": steps[:STEPS],
        "outcome": shortened(wire.error, 400),
        "notes": list(_notes(wire, len(steps))),
    }


def _all(wire: Wire) -> list[Conversation]:
    return [*([wire.lookup] if wire.lookup else []), *wire.conversations]


def _names(wire: Wire) -> dict[str, str]:
    """Return who is at both ends, as they call themselves in the first headers that say so."""
    names = {"client": "the client", "server": "the server", "master": "master"}
    for conversation in reversed(wire.conversations):
        for end, by_client in (("client", True), ("server", False)):
            said = said_first(conversation.said(by_client=by_client)).get("callerid")
            names[end] = said or names[end]
    return names


def _notes(wire: Wire, steps: int) -> Iterator[str]:
    if steps > STEPS:
        yield f"Shown are the first {STEPS} of {steps} steps."
    if wire.missed:
        yield f"{wire.missed} more connections were passed on and not taken down."
    if lost := sum(each.lost for each in _all(wire)):
        yield f"{lost:,} bytes more were passed on and not taken down."


def _step(title: str, source: str, to: str, seconds: float, **more: Any) -> Step:  # noqa: ANN401
    blank = {"says": "", "size": 0, "pieces": [], "text": "", "bad": False, "connection": 0}
    return {"title": title, "from": source, "to": to, "ms": round(seconds * 1000, 3), **blank, **more}


def _look_up(wire: Wire, begun: float) -> Iterator[Step]:
    spoken = wire.lookup
    if spoken is None:
        return
    asked, answered = spoken.said(by_client=True), spoken.said(by_client=False)
    offset = spoken.opened - begun
    yield _step(
        f"Look-up: where is {wire.service}?",
        "client",
        "master",
        offset + spoken.since(0, by_client=True),
        says="XML-RPC: a method and its arguments as XML, sent by HTTP. Only the look-up goes to the master.",
        size=len(asked),
        text=_xml(asked),
    )
    there = bool(wire.uri)
    yield _step(
        f"It is at {wire.uri}" if there else "Nobody serves it",
        "master",
        "client",
        offset + spoken.since(0, by_client=False),
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


class _Spoken:
    """One connection, as steps."""

    def __init__(self, conversation: Conversation, number: int, wire: Wire, begun: float, find: Find) -> None:
        self._spoken = conversation
        self._number = number
        self._wire = wire
        self._offset = conversation.opened - begun
        self._find = find
        self._sent = conversation.said(by_client=True)
        self._came = conversation.said(by_client=False)
        self._asked, self._answered = said_first(self._sent), said_first(self._came)

    def steps(self) -> list[Step]:
        """Return all of them, in order."""
        return [*self._opening(), *self._headers(), *self._calls(), *self._ending()]

    def _at(self, title: str, by_client: bool, at: int, **more: Any) -> Step:  # noqa: ANN401
        ends = ("client", "server") if by_client else ("server", "client")
        seconds = self._offset + self._spoken.since(at, by_client=by_client)
        return _step(title, *ends, seconds, connection=self._number, **more)

    def _opening(self) -> Iterator[Step]:
        where = self._wire.uri.rpartition("/")[2] or "the server"
        refused = self._spoken.refused
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
                "A header with the one field error: the reason in words. Then the server hangs up, and no "
                "request is ever sent."
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

    def _framed(self, title: str, by_client: bool, frame: Frame, pieces: Pieces, **more: Any) -> Step:  # noqa: ANN401
        return self._at(title, by_client, frame.at, size=len(frame.data), pieces=pieces, **more)

    def _ending(self) -> Iterator[Step]:
        if not self._spoken.closed_by:
            return
        by_client = self._spoken.closed_by == "client"
        lost = self._unanswered()
        title = "The connection is closed"
        if lost:
            title = "The client gives up" if by_client else "The server hangs up without an answer"
        says = self._farewell(lost)
        yield self._at(title, by_client or not lost, 1 << 62, says=says, bad=lost)

    def _farewell(self, lost: bool) -> str:
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
