"""The bytes of real calls, taken down on their way between rospy and a server.

The look-up and the connection go through relays (relay.py), which pass on every byte. The client is rospy's
own transport, or whoever calls while a Wiretap stands in for the server at the master.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any

import rospy
from rospy.core import parse_rosrpc_uri

from course_pkg.errors import CourseError, GraphError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.master import master_uri
from course_pkg.graph.probe import ask_all, header_fields, service_probe
from course_pkg.graph.relay import Conversation, Relay
from course_pkg.graph.rpc import MasterClient, address_of
from course_pkg.interfaces import ServiceType, service_type

LOOK = 2.0  # s for a server to say of which type it is
LAST = 0.5  # s for a tap's last connection to end, whose client has its answer


@dataclass
class Wire:
    """What was taken down: the look-up, if it was, and connections; of a tap it grows until the tap ends.

    `response` or `error` is how the call ended, where it was made here. `missed` connections were too many.
    """

    service: str
    lookup: Conversation | None = None
    uri: str = ""  # what the master said: rosrpc://HOST:PORT
    conversations: Sequence[Conversation] = ()
    response: Any = None
    error: str = ""
    missed: int = 0
    kind: ServiceType | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        return f"<the bytes of {self.service}>"


def record_call(
    name: str,
    kind: Any = None,  # noqa: ANN401 -- a generated class, a ServiceType or a name
    headers: Mapping[str, str] | None = None,
    fields: Mapping[str, Any] | None = None,
    timeout: float = 5.0,
) -> Wire:
    """Call a service as rospy does, with a connection of its own, and return the bytes of it.

    Without `kind` it is of the type that its server says. A call that fails is on record like any other, with
    its error in words; what is wrong with `fields` raises FieldError, an unknown type UnknownType.
    """
    full = str(rospy.resolve_name(name))
    found = service_type(kind) if kind is not None else _announced(full)
    wire = Wire(full, kind=found)
    if found is None:
        with _master_relay() as relay:
            _look_up(full, relay, wire, timeout)
        wire.error = f"service [{full}] unavailable" if not wire.uri else "the server does not say its type"
        return wire
    request = found.request.to_message({**found.request.default(), **(fields or {})})
    proxy = _Relayed(full, found, wire, headers, timeout)
    try:
        wire.response = proxy.call(request)
    except (rospy.ServiceException, rospy.exceptions.TransportException, CourseError, OSError) as error:
        wire.error = f"{type(error).__name__}: {error}"
    finally:
        proxy.end()
    return wire


class Wiretap:
    """Takes down the calls of a service, whoever makes them: `with Wiretap("/getGeometry") as wire: …`.

    While the block lasts the master leads to a relay, and afterwards to the server again. A connection that
    was opened before, such as a persistent one, does not pass here; one that does ends with the block.
    Raises GraphError when nobody serves the name.
    """

    def __init__(self, name: str) -> None:
        self._wire = Wire(str(rospy.resolve_name(name)))
        self._master = MasterClient(master_uri())
        self._owner, self._owner_uri = "", ""
        self._relay: Relay | None = None

    def __enter__(self) -> Wire:
        name = self._wire.service
        uri = self._master.lookup_service(name)
        self._owner = next(iter(self._master.system_state().services.get(name, ())), "")
        if uri is None or not self._owner:
            raise GraphError(f"Nobody serves {name}: start its server, and tap it then.")
        self._owner_uri = self._master.lookup_node(self._owner) or ""
        self._wire.uri = uri
        self._relay = Relay(*parse_rosrpc_uri(uri))
        self._register(self._mine)
        return self._wire

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        relay = self._relay
        assert relay is not None
        try:
            if self._master.lookup_service(self._wire.service) == self._mine:  # and nobody else's meanwhile
                self._register(self._wire.uri)
        finally:
            relay.settle(LAST)
            relay.close()
            self._wire.conversations, self._wire.missed = relay.conversations, relay.missed

    @property
    def _mine(self) -> str:
        assert self._relay is not None
        return f"rosrpc://localhost:{self._relay.port}"

    def _register(self, uri: str) -> None:
        self._master.register_service(self._owner, self._wire.service, uri, self._owner_uri)


class _Relayed(BoundedProxy):
    """A proxy for one call, whose look-up and connection go through relays."""

    def __init__(
        self,
        name: str,
        kind: ServiceType,
        wire: Wire,
        headers: Mapping[str, str] | None,
        timeout: float,
    ) -> None:
        super().__init__(name, kind, headers=dict(headers or {}), timeout=timeout)
        self._wire = wire
        self._relay: Relay | None = None

    def _looked_up(self, call: Any) -> str:  # noqa: ANN401 -- of the proxy's own
        with _master_relay() as relay:
            _look_up(self.resolved_name, relay, self._wire, call.rest())
        if not self._wire.uri:
            raise rospy.ServiceException(f"service [{self.resolved_name}] unavailable")
        self.uri = self._wire.uri
        self._relay = Relay(*parse_rosrpc_uri(self.uri))
        return f"rosrpc://localhost:{self._relay.port}"

    def end(self) -> None:
        """Close all, and put what passed on record."""
        self.close()
        if self._relay is not None:
            self._relay.settle()
            self._relay.close()
            self._wire.conversations = self._relay.conversations


def _master_relay() -> Relay:
    return Relay(*address_of(master_uri()))


def _look_up(name: str, relay: Relay, wire: Wire, timeout: float) -> None:
    """Ask the master through a relay, as this node."""
    master = MasterClient(f"http://localhost:{relay.port}", caller=str(rospy.get_name()))
    try:
        wire.uri = master.lookup_service(name, timeout) or ""
    finally:
        master.close()
        relay.settle()
        wire.lookup = next(iter(relay.conversations), None)


def _announced(name: str) -> ServiceType | None:
    """Return the type that the server of `name` says it is of, or None where there is none that answers."""
    uri = MasterClient(master_uri()).lookup_service(name)
    if uri is None:
        return None
    probe = service_probe(name, uri)
    ask_all([probe], LOOK)
    kind = header_fields(probe.answer).get("type") if probe.answered else None
    return service_type(kind) if kind else None
