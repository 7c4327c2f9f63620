"""The data of the wire view: the steps of a call, each with the pieces of its bytes.

The input is a recording from ros/wire/capture.py, so this module does not need a master.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, TypedDict

from course_pkg.panels.wire.anatomy import header_values
from course_pkg.panels.wire.connection_steps import ConnectionSteps, FindType, Step, new_step
from course_pkg.panels.wire.pieces import shortened
from course_pkg.types import service_type

if TYPE_CHECKING:
    from course_pkg.ros.wire.capture import Wire
    from course_pkg.ros.wire.relay import RelayedConnection

STEPS = 60  # At most this many steps of a recording are shown.
XML = 900  # At most this many characters of a request to the master, or of the master's response, are shown.


class WireState(TypedDict):
    """A captured call for the page; `names` are the names of the client, the server and the master.

    `outcome` is the error message of the call, if it failed.
    """

    service: str
    names: dict[str, str]
    steps: list[Step]
    outcome: str
    notes: list[str]


def state(wire: Wire, find: FindType = service_type) -> WireState:
    """Return the data of a recording for the page.

    The function `find` returns the service type with a given name. `find` is called if the recording does not
    contain the type with the name in the server's connection header.
    """
    start = min((each.opened for each in _all(wire)), default=0.0)
    steps = list(_look_up(wire, start))
    for number, connection in enumerate(wire.connections, start=1):
        of_several = number if len(wire.connections) > 1 else 0
        steps += ConnectionSteps(connection, of_several, wire, start, find).steps()
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
    """Return the names of the client and the server from the first connection headers."""
    names = {"client": "the client", "server": "the server", "master": "master"}
    for connection in reversed(wire.connections):
        for end, by_client in (("client", True), ("server", False)):
            said = header_values(connection.data(from_client=by_client)).get("callerid")
            names[end] = said or names[end]
    return names


def _notes(wire: Wire, steps: int) -> Iterator[str]:
    if steps > STEPS:
        yield f"Only the first {STEPS} of {steps} steps are shown."
    if wire.skipped:
        yield f"{wire.skipped} more connections were forwarded but not recorded."
    if lost := sum(each.lost for each in _all(wire)):
        yield f"{lost:,} more bytes were forwarded but not recorded."


def _look_up(wire: Wire, start: float) -> Iterator[Step]:
    connection = wire.lookup
    if connection is None:
        return
    asked, answered = connection.data(from_client=True), connection.data(from_client=False)
    offset = connection.opened - start
    yield new_step(
        f"Look-up: where is {wire.service}?",
        "client",
        "master",
        offset + connection.since(0, from_client=True),
        says=(
            "The look-up uses XML-RPC: the HTTP request contains the name of a method and its "
            "arguments, as XML. Only the look-up goes to the master."
        ),
        size=len(asked),
        text=_xml(asked),
    )
    there = bool(wire.uri)
    yield new_step(
        f"The service is at {wire.uri}" if there else "No node provides the service",
        "master",
        "client",
        offset + connection.since(0, from_client=False),
        says=(
            "The response contains only the address of the server. The master does not take "
            "part in the next steps."
            if there
            else "The code -1 means that the look-up failed. The client has no address, so it sends "
            "nothing more."
        ),
        size=len(answered),
        text=_xml(answered),
        bad=not there,
    )


def _xml(http: bytes) -> str:
    """Return the body of an HTTP message, with each XML value on a separate line."""
    body = http.partition(b"\r\n\r\n")[2].decode("utf-8", "replace")
    return shortened(re.sub(r"\s*\n\s*", "", body).replace("><", ">\n<"), XML)
