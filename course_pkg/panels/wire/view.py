"""The widget of the wire view: it sends a recorded call to the page."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from traitlets import Dict

from course_pkg.panels.panel import Panel
from course_pkg.panels.wire.model import state
from course_pkg.types import Plain, ServiceClass, ServiceType

if TYPE_CHECKING:
    from course_pkg.ros.wire.capture import Wire

HERE = Path(__file__).parent


class WireView(Panel):
    """The bytes of a real call: the look-up at the master, the connection headers, the request and the reply.

    `WireView("/getGeometry", length=1.2, width=5.2, height=8.9)` makes the call and shows the bytes, even if
    the call fails. `kind` is a type that the client uses instead of the server's type. `headers` are
    additional fields of the client's connection header. `WireView(wire)` shows a recorded call. The protocol
    is described at http://wiki.ros.org/ROS/TCPROS and http://wiki.ros.org/ROS/Connection%20Header.
    """

    front_end: ClassVar[Path] = HERE / "wire.js"
    style_sheet: ClassVar[Path] = HERE / "wire.css"
    errors: ClassVar[tuple[str, ...]] = ("notice", "exchange")

    exchange = Dict(help="the steps of the call and their pieces; see model.py").tag(sync=True)

    def __init__(
        self,
        call: str | Wire,
        kind: str | ServiceType | ServiceClass | None = None,
        headers: Mapping[str, str] | None = None,
        /,
        **fields: Plain,
    ) -> None:
        self.wire = _recorded(call, kind, headers, fields) if isinstance(call, str) else call
        super().__init__()
        self.publish(exchange=state(self.wire))

    @property
    def from_client(self) -> bytes:
        """The bytes that the client sent to the server, or b"" without a connection."""
        return self._bytes(client=True)

    @property
    def from_server(self) -> bytes:
        """The bytes that the server sent to the client, or b"" without a connection."""
        return self._bytes(client=False)

    def error_message(self) -> str:
        """Return the error of the panel itself or, if there is none, the error of the call."""
        return super().error_message() or str(self.exchange.get("outcome", ""))

    def _bytes(self, *, client: bool) -> bytes:
        return b"".join(each.data(from_client=client) for each in self.wire.connections)

    def __repr__(self) -> str:
        return f"WireView({self.wire.service!r})"


def _recorded(
    name: str,
    kind: str | ServiceType | ServiceClass | None,
    headers: Mapping[str, str] | None,
    fields: Mapping[str, Plain],
) -> Wire:
    # capture.py imports rospy, but a page with a recorded call does not need rospy.
    from course_pkg.ros.wire.capture import record_call

    return record_call(name, kind, headers, fields)
