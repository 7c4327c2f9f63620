"""The bytes of a real call, recorded between a client and a server.

The lookup at the master and the connection to the server go through relays (relay.py), which forward all
bytes. The client is a transport object of rospy.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import genpy
import rospy
from rospy.core import parse_rosrpc_uri

from course_pkg.errors import CourseError
from course_pkg.ros.node.proxy import BoundedProxy, _Call
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import ask_all, header_fields, service_probe
from course_pkg.ros.protocol.xmlrpc import address_of
from course_pkg.ros.wire.relay import Relay, RelayedConnection
from course_pkg.types import Plain, ServiceClass, ServiceType, service_type

TYPE_TIMEOUT = 2.0  # A server has to respond with its type within this time in s.


@dataclass
class Wire:
    """The recorded bytes of a call: the lookup at the master, if any, and the connections.

    `response` or `error` is the result of the call. `skipped` is the number of connections with no stored
    bytes.
    """

    service: str
    lookup: RelayedConnection | None = None
    uri: str = ""  # The master's response to the lookup: rosrpc://HOST:PORT
    connections: Sequence[RelayedConnection] = ()
    response: genpy.Message | None = None
    error: str = ""
    skipped: int = 0
    kind: ServiceType | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        return f"<the bytes of {self.service}>"


def record_call(
    name: str,
    kind: str | ServiceType | ServiceClass | None = None,
    headers: Mapping[str, str] | None = None,
    fields: Mapping[str, Plain] | None = None,
    timeout: float = 5.0,
) -> Wire:
    """Call a service as rospy does, on a new connection, and return the recorded bytes.

    If `kind` is not given, the call uses the type that the server reports. A failed call is also recorded,
    with its error message. `timeout` is in s. Raises FieldError if a value in `fields` is wrong, and
    UnknownType if the type is unknown.
    """
    full = str(rospy.resolve_name(name))
    found = service_type(kind) if kind is not None else _type_of_server(full)
    wire = Wire(full, kind=found)
    if found is None:
        with _master_relay() as relay:
            _look_up(full, relay, wire, timeout)
        wire.error = f"service [{full}] unavailable" if not wire.uri else "the server did not report its type"
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


class _Relayed(BoundedProxy):
    """A proxy for one call; relays forward its lookup and its connection."""

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

    def _looked_up(self, call: _Call) -> str:
        with _master_relay() as relay:
            _look_up(self.resolved_name, relay, self._wire, call.left())
        if not self._wire.uri:
            raise rospy.ServiceException(f"service [{self.resolved_name}] unavailable")
        self.uri = self._wire.uri
        self._relay = Relay(*parse_rosrpc_uri(self.uri))
        return f"rosrpc://localhost:{self._relay.port}"

    def end(self) -> None:
        """Close the connections, and store their bytes in the Wire object."""
        self.close()
        if self._relay is not None:
            self._relay.wait()
            self._relay.close()
            self._wire.connections = self._relay.connections


def _master_relay() -> Relay:
    return Relay(*address_of(master_uri()))


def _look_up(name: str, relay: Relay, wire: Wire, timeout: float) -> None:
    """Look up the service at the master through a relay, with the name of this process's node."""
    master = MasterClient(f"http://localhost:{relay.port}", caller=str(rospy.get_name()))
    try:
        wire.uri = master.lookup_service(name, timeout) or ""
    finally:
        master.close()
        relay.wait()
        wire.lookup = next(iter(relay.connections), None)


def _type_of_server(name: str) -> ServiceType | None:
    """Return the type that the server of the service reports, or None if no server answers."""
    uri = MasterClient(master_uri()).lookup_service(name)
    if uri is None:
        return None
    probe = service_probe(name, uri)
    ask_all([probe], TYPE_TIMEOUT)
    kind = header_fields(probe.answer).get("type") if probe.answered else None
    return service_type(kind) if kind else None
